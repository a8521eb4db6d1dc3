// Kernels of plane_weight: exponents from the centre's tangent plane.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

namespace quell {

struct PlaneGuides {
  const float *x, *y, *z;     // position
  const float *nx, *ny, *nz;  // normal
};

void plane_weigh_sine(const quell_run&, PlaneGuides, Falloff, float sigma, float* exponent);
void plane_weigh_distance(const quell_run&, PlaneGuides, Falloff, float sigma, float* exponent);

}  // namespace quell
