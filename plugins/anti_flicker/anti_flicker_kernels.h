// The kernels of anti_flicker. Rows at pixel x = 0.
#pragma once

#include "outlier_clamp/window_range.h"

namespace quell {

// (R + 2G + B)/4 of pixels [x0, x1), on the scale of log(1 + x) where `compress`.
void luma_row(const float* const in[3], bool compress, int x0, int x1, float* out);

// The factor for pixels [x0, x1) of row y; the window's plane holds luma now, `then` luma of history.
void flicker_row(const WindowRange&, int y, int x0, int x1, const float* then, float* out);

}  // namespace quell
