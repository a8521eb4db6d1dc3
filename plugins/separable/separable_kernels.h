// The kernel of separable: the gather engine on one tile.
#pragma once

#include <quell/taps.h>

namespace quell {

void separable_tile(const Gather&, const quell_tile&, const quell_image& out);

}  // namespace quell
