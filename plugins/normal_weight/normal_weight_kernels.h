// Kernels of normal_weight: exponents from three planes of unit normals.
#pragma once

#include <quell/abi.h>

namespace quell {

struct NormalPlanes {
  const float *x, *y, *z;
};

void normal_weigh_power(const quell_run&, NormalPlanes, float power, float* exponent);
void normal_weigh_angle(const quell_run&, NormalPlanes, float sigma, float* exponent);

}  // namespace quell
