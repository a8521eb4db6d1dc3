// The kernel of motion_color.
#pragma once

namespace quell {

// Pixels [x0, x1) of rows at pixel x = 0.
void motion_color_row(float longest, int x0, int x1, const float* dx, const float* dy, float* const out[3]);

}  // namespace quell
