// The kernel of disoccluded_share.
#pragma once

#include "disocclusion/taps.h"

namespace quell {

// Pixels of a row that have no valid tap, by their masks.
int count_disoccluded(const std::uint32_t* mask, int width);

}  // namespace quell
