// A pinhole camera at one time, with square pixels, whose matrices are those of the `camera` type.
#pragma once

#include "path_tracer/scene.h"

namespace path_tracer {

class Camera {
 public:
  Camera(const CameraTrack&, double time, int width, int height);

  // Through a point of the image, pixels; the direction has length 1 along the view axis, so that t is the depth.
  Ray ray(double x, double y) const;
  // Row-major in meaning: element (row, column) is m[column][row]. View is x right, y up, z forward; screen is to be
  // divided by w.
  const Mat& world_to_view() const { return view_; }
  const Mat& world_to_screen() const { return screen_; }
  // Where a homogeneous point (w = 0: a direction) lands on the image; false if it is not before the camera.
  bool project(const glm::dvec4& world, glm::dvec2& pixel) const;

 private:
  Vec position_, right_, up_, forward_;
  double focal_;  // pixels
  glm::dvec2 center_;
  Mat view_, screen_;
};

}  // namespace path_tracer
