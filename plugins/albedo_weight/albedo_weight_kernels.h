// Kernel of albedo_weight: exponents from three planes.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

namespace quell {

void albedo_weigh(const quell_run&, const float* const* planes, Falloff, float sigma, float* exponent);

}  // namespace quell
