// Estimates the light that reaches the camera along a ray.
#pragma once

#include "path_tracer/lights.h"
#include "path_tracer/sampler.h"

namespace path_tracer {

// One moment of a scene, ready to be traced. Borrows everything.
struct Moment {
  const Scene& scene;
  const Geometry& geometry;
  const Placement& placement;
  const Lights& lights;
};

// Radiance, and the parts of it that the first surface scattered by its matte base and by gloss; what is left was seen
// directly. Beside it, the features of the first surface on the path that scatters widely: its colour under the tints
// of the mirrors, metals and glass before it, and its normal. A path that meets none has the tints alone and the normal
// where it began; one that begins in a lamp or in the environment has no albedo.
struct Traced {
  Rgb all{0}, diffuse{0}, specular{0};
  Rgb albedo{0};
  Vec normal{0};
};

// One sample of the radiance along `ray`, whose first hit is given: unidirectional path tracing, at each vertex one
// lamp and one scattered direction, combined by the balance heuristic (Veach and Guibas 1995, eq. 12). A path ends
// after `max_bounces` scatterings, and earlier by Russian roulette on its throughput.
Traced path_radiance(const Moment&, const Ray& ray, const std::optional<Hit>& first, const Sampler&, int max_bounces);

}  // namespace path_tracer
