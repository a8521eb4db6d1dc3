// The kernel of luminance_moments.
#pragma once

namespace quell {

// Luminance and its square of pixels [x0, x1); rows at pixel x = 0.
void moments_row(int x0, int x1, const float* const image[3], float* first, float* second);

}  // namespace quell
