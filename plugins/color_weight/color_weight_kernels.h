// Kernels of color_weight: exponents from the squared distance of any number of channels.
#pragma once

#include <quell/abi.h>

namespace quell {

void color_weigh(const quell_run&, const float* const* planes, int channels, float sigma, float* exponent);

}  // namespace quell
