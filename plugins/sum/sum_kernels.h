// The kernel of sum.
#pragma once

namespace quell {

// Pixels [x0, x1) of a row: a + b, or b alone where a is nullptr.
void add_row(const float* a, const float* b, float* out, int x0, int x1);

}  // namespace quell
