// The kernel of demodulate.
#pragma once

#include "demodulate/rule.h"

namespace quell {

// Pixels [x0, x1) of rows at pixel x = 0.
void demodulate_row(const demodulation::Rule&, int x0, int x1, const float* const image[3],
                    const float* const albedo[3], float* const out[3]);

}  // namespace quell
