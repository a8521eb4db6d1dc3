// Turns normals between the camera's space and the world's.
#include "motion_vectors/matrices.h"

#include <quell/node.h>

#include <cmath>
#include <stdexcept>

namespace {

enum class To : std::int32_t { world, view };

struct NormalSpace {
  quell::In<quell::Normal> normal;
  quell::In<quell::Camera> camera;
  quell::Out<quell::Normal> turned;
  To to = To::world;

  void describe(quell::Describe& d) {
    d.summary("Normals of view space in world space, or the other way round.");
    d.source("Normals go by the inverse transpose of the matrix that points go by.");
    d.in(normal, "normal",
         "Unit normals in the other space; view space is x right, y up, z forward. (0,0,0) is a miss.");
    d.in(camera, "camera", "This frame's camera; its world-to-view matrix is what is used.").anywhere();
    d.out(turned, "normal", "Unit normals in the space asked for; (0,0,0) at a miss.").passes(normal);
    d.param(to, "to", "The space of what comes out.", {"world", "view"});
  }

  void run(const quell::Tile& tile) const {
    const glm::dmat3 view(quell::matrix(tile[camera], 0));
    if (glm::determinant(view) == 0)
      throw std::runtime_error("the camera's world-to-view matrix has no inverse, so normals cannot be turned by it");
    const glm::dmat3 turn = to == To::world ? glm::transpose(view) : glm::transpose(glm::inverse(view));
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const glm::dvec3 n(tile.row(normal, 0, y)[x], tile.row(normal, 1, y)[x], tile.row(normal, 2, y)[x]);
        const auto t = turn * n;
        const double length = std::sqrt(glm::dot(t, t));
        for (int c = 0; c < 3; ++c) tile.row(turned, c, y)[x] = length > 1e-6 ? float(t[c] / length) : 0;
      }
  }
};

}  // namespace
QUELL_PLUGIN("normal_space", NormalSpace)
