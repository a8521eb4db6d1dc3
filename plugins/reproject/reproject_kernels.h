// The kernel of reproject.
#pragma once

#include "disocclusion/taps.h"

namespace quell {

enum class WarpFilter : std::int32_t { bilinear, nearest, catmull_rom };

// Pixels [x0, x1) of the row, all channels: `from` averaged by the taps.
void warp_row(WarpFilter, const TapsRow&, int x0, int x1, const quell_image& from, const quell_image& to);

}  // namespace quell
