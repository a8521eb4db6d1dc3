// Kernels of luminance_weight: exponents from radiance and, where there is one, the variance of its luminance.
#pragma once

#include <quell/abi.h>

namespace quell {

struct RgbPlanes {
  const float *r, *g, *b;
};

// variance may be null.
void luminance_weigh(const quell_run&, RgbPlanes image, const float* variance, float sigma, float epsilon,
                     float* exponent);

}  // namespace quell
