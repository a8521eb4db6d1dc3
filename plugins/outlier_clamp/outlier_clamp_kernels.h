// The kernels of outlier_clamp.
#pragma once

#include "outlier_clamp/window_range.h"

namespace quell {

// Pixels [x0, x1) of row y of one channel, whose statistics come from the same channel.
void clamp_channel(const WindowRange&, int y, int x0, int x1, float* out);

// All three channels, scaled by what luminance, the window's plane, needs. Rows at pixel x = 0.
void clamp_luminance(const WindowRange&, int y, int x0, int x1, const float* const in[3], float* const out[3]);

// Rec. 709 luminance of pixels [x0, x1).
void luminance_row(const float* const in[3], int x0, int x1, float* out);

}  // namespace quell
