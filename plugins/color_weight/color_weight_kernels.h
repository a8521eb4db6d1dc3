// Kernel of color_weight: exponents from the distance over any number of channels.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

namespace quell {

void color_weigh(const quell_run&, const float* const* planes, int channels, Falloff, float sigma, float* exponent);

}  // namespace quell
