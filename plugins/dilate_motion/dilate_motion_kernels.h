// The kernel of dilate_motion.
#pragma once

#include <cstddef>
#include <cstdint>

namespace quell {

enum class DilateBy : std::int32_t { length, depth };

// Planes at pixel (0, 0).
struct MotionField {
  const float* motion[2];
  const float* depth;
  int width, height;
  std::ptrdiff_t pitch;
};

// Pixels [x0, x1) of row y; out points at pixel x = 0.
void dilate_row(const MotionField&, DilateBy, int radius, int y, int x0, int x1, float* const out[2]);

}  // namespace quell
