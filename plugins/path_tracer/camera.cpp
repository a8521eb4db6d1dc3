// Camera matrices.
#include "path_tracer/camera.h"

namespace path_tracer {

Camera::Camera(const CameraTrack& track, double time, int width, int height) {
  const auto v = track.sample(time);
  position_ = {v[0], v[1], v[2]};
  forward_ = glm::normalize(Vec(v[3], v[4], v[5]) - position_);
  right_ = glm::normalize(glm::cross(forward_, Vec(0, 1, 0)));
  up_ = glm::cross(right_, forward_);
  focal_ = 0.5 * width / std::tan(0.5 * glm::radians(v[6]));
  center_ = {0.5 * width, 0.5 * height};
  const Mat rows(glm::dvec4(right_, -glm::dot(right_, position_)), glm::dvec4(up_, -glm::dot(up_, position_)),
                 glm::dvec4(forward_, -glm::dot(forward_, position_)), glm::dvec4(0, 0, 0, 1));
  view_ = glm::transpose(rows);
  // The third row only keeps the matrix invertible.
  const Mat lens(glm::dvec4(focal_, 0, center_.x, 0), glm::dvec4(0, -focal_, center_.y, 0), glm::dvec4(0, 0, 1, -0.01),
                 glm::dvec4(0, 0, 1, 0));
  screen_ = glm::transpose(lens) * view_;
}

Ray Camera::ray(double x, double y) const {
  return {position_, forward_ + right_ * ((x - center_.x) / focal_) - up_ * ((y - center_.y) / focal_)};
}

bool Camera::project(const glm::dvec4& world, glm::dvec2& pixel) const {
  const glm::dvec4 p = screen_ * world;
  if (!(p.w > 1e-9)) return false;
  pixel = {p.x / p.w, p.y / p.w};
  return true;
}

}  // namespace path_tracer
