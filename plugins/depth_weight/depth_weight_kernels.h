// Kernels of depth_weight: exponents from depth and, where there is one, its slope.
#pragma once

#include <quell/abi.h>

namespace quell {

struct DepthFalloff {
  float sigma, epsilon;
  bool relative;
};

void depth_weigh_sloped(const quell_run&, const float* depth, const float* slope_x, const float* slope_y, DepthFalloff,
                        float* exponent);
void depth_weigh_plain(const quell_run&, const float* depth, DepthFalloff, float* exponent);

}  // namespace quell
