// The kernel of depth_slope.
#pragma once

namespace quell {

// Pixels [x0, x1) of one row and its neighbours, nullptr beyond the image; rows at pixel x = 0.
void slope_row(const float* above, const float* here, const float* below, int width, int x0, int x1, float* dx,
               float* dy);

}  // namespace quell
