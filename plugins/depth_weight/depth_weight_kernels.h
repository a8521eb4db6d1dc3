// Kernels of depth_weight: exponents from depth and, where there is one, its slope.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

namespace quell {

struct DepthFalloff {
  Falloff falloff;
  float sigma, epsilon;
  bool relative;
};

void depth_weigh_sloped(const quell_run&, const float* depth, const float* slope_x, const float* slope_y, DepthFalloff,
                        float* exponent);
void depth_weigh_plain(const quell_run&, const float* depth, DepthFalloff, float* exponent);

}  // namespace quell
