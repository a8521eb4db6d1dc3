// The kernel of exposure.
#pragma once

namespace quell {

// Pixels [x0, x1) of rows at pixel x = 0, times a factor; finite where `in` is.
void scale_row(float factor, int x0, int x1, const float* in, float* out);

}  // namespace quell
