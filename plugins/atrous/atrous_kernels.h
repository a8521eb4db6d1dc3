// The kernel of atrous: the gather engine on one tile.
#pragma once

#include <quell/taps.h>

namespace quell {

void atrous_tile(const Gather&, const quell_tile&, int step, const quell_image& out, float* out_variance);

}  // namespace quell
