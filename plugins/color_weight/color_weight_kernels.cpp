// Exponents of color_weight, two vectors of pixels a step.
#include "color_weight/color_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

void three(const quell_run& run, const float* r, const float* g, const float* b, float sigma, float* exponent) {
  const V scale = all(kLog2E / (2 * sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V pr = p(r), pg = p(g), pb = p(b);
    return [=](auto q) HWY_ATTR {
      const V dr = q(r) - pr, dg = q(g) - pg, db = q(b) - pb;
      return mul_add(dr, dr, mul_add(dg, dg, db * db)) * scale;
    };
  });
}
void one(const quell_run& run, const float* plane, float sigma, float* exponent) {
  const V scale = all(kLog2E / (2 * sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V centre = p(plane);
    return [=](auto q) HWY_ATTR {
      const V difference = q(plane) - centre;
      return difference * difference * scale;
    };
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(three);
HWY_EXPORT(one);

// The exponent is a sum over channels, so channel after channel may be added; three at once are the common case.
void color_weigh(const quell_run& run, const float* const* planes, int channels, float sigma, float* exponent) {
  quell_run rest = run;
  int c = 0;
  for (; c + 3 <= channels; c += 3, rest.store = 0)
    HWY_DYNAMIC_DISPATCH(three)(rest, planes[c], planes[c + 1], planes[c + 2], sigma, exponent);
  for (; c < channels; ++c, rest.store = 0) HWY_DYNAMIC_DISPATCH(one)(rest, planes[c], sigma, exponent);
}

}  // namespace quell
#endif
