// Exponents of color_weight, two vectors of pixels a step.
#include "color_weight/color_weight_kernels.h"

#include "color_weight/squared_distance.h"

QUELL_SIMD_BEGIN
void weigh(const quell_run& run, const float* const* planes, int channels, Falloff falloff, float sigma,
           float* exponent) {
  weigh_by_distance(run, planes, channels, falloff, sigma, exponent);
}
QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(weigh);
void color_weigh(const quell_run& run, const float* const* planes, int channels, Falloff falloff, float sigma,
                 float* exponent) {
  HWY_DYNAMIC_DISPATCH(weigh)(run, planes, channels, falloff, sigma, exponent);
}

}  // namespace quell
#endif
