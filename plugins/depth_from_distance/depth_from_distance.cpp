// Turns distances along rays into depths, for renderers that give the former.
#include "position_from_depth/rays.h"

#include <quell/node.h>

namespace {

// Farther than this, a distance is a renderer's way of saying that nothing was hit.
constexpr float kBeyond = 1e10f;

struct DepthFromDistance {
  quell::In<quell::Scalar> distance;
  quell::In<quell::Camera> camera;
  quell::Out<quell::Depth> depth;

  void describe(quell::Describe& d) {
    d.summary("Depth along the view axis from the distance along the ray.");
    d.source("Mitsuba 3's aov integrator, among others, writes the ray's distance t: z = t · cos θ.");
    d.in(distance, "distance", "From the camera to the surface, scene units; a miss is 0, negative or at least 1e10.");
    d.in(camera, "camera", "This frame's pinhole camera. One that is missing sees nothing: all is a miss.").anywhere();
    d.out(depth, "depth", "Distance along the view axis; 1e30 at a miss.");
  }

  void run(const quell::Tile& tile) const {
    const auto rays = quell::rays_of(tile[camera]);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float t = tile.row(distance, 0, y)[x];
        const bool hit = rays && t > 0 && t < kBeyond;
        tile.row(depth, 0, y)[x] = hit ? float(t * rays->cosine(x, y)) : quell::kFar;
      }
  }
};

}  // namespace
QUELL_PLUGIN("depth_from_distance", DepthFromDistance)
