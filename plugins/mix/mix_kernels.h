// The kernel of mix.
#pragma once

namespace quell {

// Pixels [x0, x1) of one channel; rows at pixel x = 0.
void mix_row(int x0, int x1, const float* image, const float* other, const float* share, float* out);

}  // namespace quell
