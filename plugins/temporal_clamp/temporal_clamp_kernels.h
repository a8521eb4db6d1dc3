// The kernel of temporal_clamp.
#pragma once

#include "outlier_clamp/window_range.h"

namespace quell {

// Pixels [x0, x1) of row y of one channel: history clamped into the window's ranges. Rows at pixel x = 0.
void clamp_history(const WindowRange&, int y, int x0, int x1, const float* history, float* out);

}  // namespace quell
