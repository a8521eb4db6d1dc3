// Rays of a pinhole camera, from its two matrices: which point a pixel shows at a depth, and how far that is.
#pragma once

#include "motion_vectors/matrices.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace quell {

class Rays {
 public:
  explicit Rays(const quell_image& camera) {
    const auto view = matrix(camera, 0), screen = matrix(camera, 1);
    const auto forward = directions(screen);
    if (glm::determinant(forward) == 0)
      throw std::runtime_error(
          "the camera's world-to-screen matrix has no centre of projection (orthographic or singular): only pinhole "
          "cameras have a ray for each pixel");
    ray_ = glm::inverse(forward);
    centre_ = -(ray_ * glm::dvec3(screen[3][0], screen[3][1], screen[3][3]));
    axis_ = {view[0][2], view[1][2], view[2][2]};
  }

  // World position of what pixel (x, y) shows at this depth along the view axis.
  glm::dvec3 position(int x, int y, double depth) const {
    const auto r = ray(x, y);
    return centre_ + r * (depth / glm::dot(axis_, r));
  }
  // Depth along the view axis for each unit of distance along the ray of pixel (x, y): the cosine between the two.
  double cosine(int x, int y) const {
    const auto r = ray(x, y);
    return std::abs(glm::dot(axis_, r)) / std::sqrt(glm::dot(r, r));
  }

 private:
  glm::dvec3 ray(int x, int y) const { return ray_ * glm::dvec3(x + 0.5, y + 0.5, 1); }

  glm::dmat3 ray_;
  glm::dvec3 centre_, axis_;
};

// Nothing where the camera is a delayed wire that has no past.
inline std::optional<Rays> rays_of(const quell_image& camera) {
  return camera.missing ? std::nullopt : std::optional<Rays>(camera);
}

}  // namespace quell
