// Kernels of normal_weight: exponents from three planes of unit normals.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

namespace quell {

struct NormalPlanes {
  const float *x, *y, *z;
};

void normal_weigh_power(const quell_run&, NormalPlanes, float power, float* exponent);
void normal_weigh_angle(const quell_run&, NormalPlanes, Falloff, float sigma, float* exponent);
void normal_weigh_difference(const quell_run&, NormalPlanes, Falloff, float sigma, float* exponent);

}  // namespace quell
