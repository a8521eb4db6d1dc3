// Exponents of albedo_weight, two vectors of pixels a step.
#include "albedo_weight/albedo_weight_kernels.h"

#include "color_weight/squared_distance.h"

QUELL_SIMD_BEGIN
void weigh(const quell_run& run, const float* const* planes, Falloff falloff, float sigma, float* exponent) {
  weigh_by_distance<Linear>(run, planes, 3, falloff, sigma, exponent);
}
QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(weigh);
void albedo_weigh(const quell_run& run, const float* const* planes, Falloff falloff, float sigma, float* exponent) {
  HWY_DYNAMIC_DISPATCH(weigh)(run, planes, falloff, sigma, exponent);
}

}  // namespace quell
#endif
