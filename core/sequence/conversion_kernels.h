// The conversions and repairs that most rows of most images need, in SIMD.
#pragma once

#include <cstddef>

namespace quell {

// All finite, and without a sign where there may be none.
bool all_clean(const float* row, std::size_t n, bool signs_allowed);

// Finite vectors to length 1; those shorter than `shortest`, whose direction says nothing, to 0.
void to_unit_length(float* const xyz[3], std::size_t n, double shortest);

// Depths to kFar where they are 0, at least `from` or not finite. Says how many were NaN.
std::size_t far_where_nothing_is(float* depth, std::size_t n, float from);

}  // namespace quell
