// Exponents of luminance_weight, two vectors of pixels a step.
#include "luminance_weight/luminance_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

HWY_INLINE V luminance_at(Pixels p, RgbPlanes image) { return luminance(p(image.r), p(image.g), p(image.b)); }

// Luminance is computed anew at each tap: a plane of it made once would gain nothing, for loads are what a tap costs.
template <class F>
void guided(const quell_run& run, RgbPlanes image, const float* variance, LuminanceFalloff by, float* exponent) {
  const V deviations = all(by.sigma / F::kUnit), least = all(by.epsilon / F::kUnit);
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V l = luminance_at(p, image);
    const V deviation = hn::Sqrt(hn::Max(p(variance), zero()));
    const V k = all(1.0f) / mul_add(deviations, deviation, least);
    return [=](auto q) HWY_ATTR { return F::of(hn::Abs(luminance_at(q, image) - l) * k); };
  });
}
template <class F>
void plain(const quell_run& run, RgbPlanes image, float sigma, float* exponent) {
  const V k = all(F::kUnit / sigma);
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V l = luminance_at(p, image);
    return [=](auto q) HWY_ATTR { return F::of(hn::Abs(luminance_at(q, image) - l) * k); };
  });
}
void weigh(const quell_run& run, RgbPlanes image, const float* variance, LuminanceFalloff by, float* exponent) {
  with_falloff(by.falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    variance ? guided<Fall>(run, image, variance, by, exponent) : plain<Fall>(run, image, by.sigma, exponent);
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(weigh);

void luminance_weigh(const quell_run& run, RgbPlanes image, const float* variance, LuminanceFalloff by,
                     float* exponent) {
  HWY_DYNAMIC_DISPATCH(weigh)(run, image, variance, by, exponent);
}

}  // namespace quell
#endif
