// Kernels of luminance_weight: exponents from radiance and, where there is one, the variance of its luminance.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

namespace quell {

struct RgbPlanes {
  const float *r, *g, *b;
};

struct LuminanceFalloff {
  Falloff falloff;
  float sigma, epsilon;
};

// variance may be null.
void luminance_weigh(const quell_run&, RgbPlanes image, const float* variance, LuminanceFalloff, float* exponent);

}  // namespace quell
