// Exponents of position_weight, two vectors of pixels a step.
#include "position_weight/position_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

void weigh(const quell_run& run, PositionPlanes s, Falloff falloff, float sigma, float* exponent) {
  with_falloff(falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    const V scale = all(Fall::kUnitSquared / (sigma * sigma));
    each(run, exponent, [=](auto p) HWY_ATTR {
      const V x = p(s.x), y = p(s.y), z = p(s.z);
      const V miss = hn::VecFromMask(d, all_zero(x, y, z));
      return [=](auto q) HWY_ATTR {
        const V qx = q(s.x), qy = q(s.y), qz = q(s.z), dx = qx - x, dy = qy - y, dz = qz - z;
        const V e = Fall::of_square(mul_add(dx, dx, mul_add(dy, dy, dz * dz)) * scale);
        return hn::IfThenElse(hn::Xor(hn::MaskFromVec(miss), all_zero(qx, qy, qz)), all(HUGE_VALF), e);
      };
    });
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(weigh);
void position_weigh(const quell_run& run, PositionPlanes p, Falloff falloff, float sigma, float* exponent) {
  HWY_DYNAMIC_DISPATCH(weigh)(run, p, falloff, sigma, exponent);
}

}  // namespace quell
#endif
