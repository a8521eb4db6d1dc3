// The kernels of luminance_cap. Rows are at pixel x = 0.
#pragma once

#include <cstddef>

namespace quell {

struct CapWindow {
  const float* luminance;  // at pixel (0, 0)
  std::ptrdiff_t pitch;
  int width, height, radius;
  int rank;     // of the neighbour that is the cap, 1 to 4; 0: their mean
  float scale;  // of the cap
};

// Rec. 709 luminance of pixels [x0, x1).
void luminances(const float* const in[3], int x0, int x1, float* out);

// Pixels [x0, x1) of row y.
void cap_luminance(const CapWindow&, int y, int x0, int x1, const float* const in[3], float* const out[3]);

}  // namespace quell
