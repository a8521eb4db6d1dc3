// The kernel of median.
#pragma once

#include <cstddef>

namespace quell {

struct MedianWindow {
  const float* plane;  // at pixel (0, 0)
  std::ptrdiff_t pitch;
  int width, height, radius;
};

// Pixels [x0, x1) of row y; radius from 1 to 3. The output row is at pixel x = 0.
void median_row(const MedianWindow&, int y, int x0, int x1, float* out);

}  // namespace quell
