// Kernel of id_weight: exponents from a plane of numbers, which are uint32 in the memory of floats.
#pragma once

#include <quell/abi.h>

namespace quell {

void id_weigh(const quell_run&, const float* id, float* exponent);

}  // namespace quell
