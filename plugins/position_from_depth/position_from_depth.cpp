// Rebuilds world positions where a renderer gives depth alone.
#include "position_from_depth/rays.h"

#include <quell/node.h>

namespace {

struct PositionFromDepth {
  quell::In<quell::Depth> depth;
  quell::In<quell::Camera> camera;
  quell::Out<quell::Position> position;

  void describe(quell::Describe& d) {
    d.summary("World positions from depth and the camera's matrices.");
    d.source("p = V⁻¹ · (x_v, y_v, z): the ray through the pixel's centre, inverted from world-to-screen in double.");
    d.in(depth, "depth", "Depth along the view axis; 1e30 is a miss.");
    d.in(camera, "camera", "This frame's pinhole camera. One that is missing sees nothing: all is a miss.").anywhere();
    d.out(position, "position", "World space; (0,0,0) at a miss.");
  }

  void run(const quell::Tile& tile) const {
    const auto rays = quell::rays_of(tile[camera]);
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* z = tile.row(depth, 0, y);
      for (int x = tile.x0; x < tile.x1; ++x) {
        const bool miss = !rays || !(z[x] < 0.5f * quell::kFar);
        const auto p = miss ? glm::dvec3(0) : rays->position(x, y, z[x]);
        for (int c = 0; c < 3; ++c) tile.row(position, c, y)[x] = float(p[c]);
      }
    }
  }
};

}  // namespace
QUELL_PLUGIN("position_from_depth", PositionFromDepth)
