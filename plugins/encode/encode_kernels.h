// Transfer curves over rows.
#pragma once

#include <cstdint>

namespace quell {

enum class Curve : std::int32_t { compress, pu };

// Pixels x0 to x1 of a row, which begins at pixel 0.
void encode_row(Curve curve, int x0, int x1, const float* in, float* out);

}  // namespace quell
