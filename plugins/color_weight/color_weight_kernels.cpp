// Exponents of color_weight, two vectors of pixels a step.
#include "color_weight/color_weight_kernels.h"

#include "color_weight/squared_distance.h"

QUELL_SIMD_BEGIN
void weigh(const quell_run& run, const float* const* planes, int channels, ColorDistance by, float* exponent) {
  switch (by.space) {
    case ColorSpace::linear:
      return weigh_by_distance<Linear>(run, planes, channels, by.falloff, by.sigma, exponent);
    case ColorSpace::log:
      return weigh_by_distance<Log>(run, planes, channels, by.falloff, by.sigma, exponent);
    case ColorSpace::sqrt:
      return weigh_by_distance<SquareRoot>(run, planes, channels, by.falloff, by.sigma, exponent);
  }
}
QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(weigh);
void color_weigh(const quell_run& run, const float* const* planes, int channels, ColorDistance by, float* exponent) {
  HWY_DYNAMIC_DISPATCH(weigh)(run, planes, channels, by, exponent);
}

}  // namespace quell
#endif
