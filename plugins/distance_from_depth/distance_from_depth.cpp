// Turns depths into distances along rays->
#include "position_from_depth/rays.h"

#include <quell/node.h>

namespace {

struct DistanceFromDepth {
  quell::In<quell::Depth> depth;
  quell::In<quell::Camera> camera;
  quell::Out<quell::Scalar> distance;

  void describe(quell::Describe& d) {
    d.summary("Distance along the ray from depth along the view axis.");
    d.source("t = z / cos θ, the inverse of depth_from_distance.");
    d.in(depth, "depth", "Distance along the view axis; 1e30 is a miss.");
    d.in(camera, "camera", "This frame's pinhole camera. One that is missing sees nothing: all is a miss.").anywhere();
    d.out(distance, "distance", "From the camera to the surface, scene units; 1e30 at a miss.");
  }

  void run(const quell::Tile& tile) const {
    const auto rays = quell::rays_of(tile[camera]);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float z = tile.row(depth, 0, y)[x];
        tile.row(distance, 0, y)[x] = rays && z < 0.5f * quell::kFar ? float(z / rays->cosine(x, y)) : quell::kFar;
      }
  }
};

}  // namespace
QUELL_PLUGIN("distance_from_depth", DistanceFromDepth)
