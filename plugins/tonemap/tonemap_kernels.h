// The kernel of tonemap.
#pragma once

#include "tonemap/tone_curve.h"

namespace quell {

// Pixels [x0, x1) of rows at pixel x = 0.
void tonemap_row(tone::Operator, tone::Encoding, int x0, int x1, const float* const image[3], float* const out[3]);

}  // namespace quell
