// The kernel of window: the gather engine on one tile.
#pragma once

#include <quell/taps.h>

namespace quell {

void window_tile(const Gather&, const quell_tile&, const quell_image& out);

}  // namespace quell
