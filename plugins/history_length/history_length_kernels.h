// The kernel of history_length.
#pragma once

#include "disocclusion/taps.h"

namespace quell {

// Pixels [x0, x1) of the row: one more than `before` averaged by the taps, at most `max`; 1 where no tap counts.
void count_row(const TapsRow&, int x0, int x1, const float* before, float max, float* out);

}  // namespace quell
