// Exponents of luminance_weight, two vectors of pixels a step.
#include "luminance_weight/luminance_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

HWY_INLINE V luminance_at(Pixels p, RgbPlanes image) { return luminance(p(image.r), p(image.g), p(image.b)); }

// Luminance is computed anew at each tap: a plane of it made once would gain nothing, for loads are what a tap costs.
void guided(const quell_run& run, RgbPlanes image, const float* variance, float sigma, float epsilon, float* exponent) {
  const V deviations = all(sigma / kLog2E), least = all(epsilon / kLog2E);  // e to powers of 2
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V l = luminance_at(p, image);
    const V deviation = hn::Sqrt(hn::Max(p(variance), zero()));
    const V k = all(1.0f) / mul_add(deviations, deviation, least);
    return [=](auto q) HWY_ATTR { return hn::Abs(luminance_at(q, image) - l) * k; };
  });
}
void plain(const quell_run& run, RgbPlanes image, float sigma, float* exponent) {
  const V k = all(kLog2E / sigma);
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V l = luminance_at(p, image);
    return [=](auto q) HWY_ATTR { return hn::Abs(luminance_at(q, image) - l) * k; };
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(guided);
HWY_EXPORT(plain);

void luminance_weigh(const quell_run& run, RgbPlanes image, const float* variance, float sigma, float epsilon,
                     float* exponent) {
  variance ? HWY_DYNAMIC_DISPATCH(guided)(run, image, variance, sigma, epsilon, exponent)
           : HWY_DYNAMIC_DISPATCH(plain)(run, image, sigma, exponent);
}

}  // namespace quell
#endif
