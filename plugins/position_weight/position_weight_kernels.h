// Kernel of position_weight: exponents from three planes of positions.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

namespace quell {

struct PositionPlanes {
  const float *x, *y, *z;
};

void position_weigh(const quell_run&, PositionPlanes, Falloff, float sigma, float* exponent);

}  // namespace quell
