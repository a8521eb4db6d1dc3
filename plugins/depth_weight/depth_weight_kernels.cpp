// Exponents of depth_weight, two vectors of pixels a step.
#include "depth_weight/depth_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

// The depth that differences are taken relative to, which must not vanish. A miss has one too large to tell anything
// apart by: 1 stands in.
HWY_INLINE V scale_of(V z) { return hn::Max(hn::IfThenElse(z < all(1e29f), z, all(1.0f)), all(1e-6f)); }

// D = |z - z'| in units of sigma · |slope·(p - q)| + epsilon, which is one for a tap and its mirror image.
void sloped(const quell_run& run, const float* depth, const float* slope_x, const float* slope_y, DepthFalloff by,
            float* exponent) {
  with_falloff(by.falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    const V sigma = all(by.sigma / Fall::kUnit), epsilon = all(by.epsilon / Fall::kUnit);
    const bool relative = by.relative;
    each_pair(run, exponent, [=](auto p) HWY_ATTR {
      const V z = p(depth), sx = p(slope_x), sy = p(slope_y);
      const V least = relative ? epsilon * scale_of(z) : epsilon;
      return [=](Offset o) HWY_ATTR {
        const V change = hn::Abs(mul_add(sx, o.dx, sy * o.dy));
        const V k = reciprocal(mul_add(sigma, change, least));
        return [=](auto q) HWY_ATTR { return Fall::of(hn::Abs(q(depth) - z) * k); };
      };
    });
  });
}

// D = |z - z'| in units of sigma, or of sigma · z.
void plain(const quell_run& run, const float* depth, DepthFalloff by, float* exponent) {
  with_falloff(by.falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    const V scale = all(Fall::kUnit / by.sigma);
    const bool relative = by.relative;
    each(run, exponent, [=](auto p) HWY_ATTR {
      const V z = p(depth);
      const V k = relative ? scale / scale_of(z) : scale;
      return [=](auto q) HWY_ATTR { return Fall::of(hn::Abs(q(depth) - z) * k); };
    });
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(sloped);
HWY_EXPORT(plain);

void depth_weigh_sloped(const quell_run& run, const float* depth, const float* slope_x, const float* slope_y,
                        DepthFalloff by, float* exponent) {
  HWY_DYNAMIC_DISPATCH(sloped)(run, depth, slope_x, slope_y, by, exponent);
}
void depth_weigh_plain(const quell_run& run, const float* depth, DepthFalloff by, float* exponent) {
  HWY_DYNAMIC_DISPATCH(plain)(run, depth, by, exponent);
}

}  // namespace quell
#endif
