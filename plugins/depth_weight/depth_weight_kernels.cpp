// Exponents of depth_weight, two vectors of pixels a step.
#include "depth_weight/depth_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

// The depth that differences are taken relative to, which must not vanish. A miss has one too large to tell anything
// apart by: 1 stands in.
HWY_INLINE V scale_of(V z) { return hn::Max(hn::IfThenElse(z < all(1e29f), z, all(1.0f)), all(1e-6f)); }

// |z - z'| / (sigma · |slope·(p - q)| + epsilon); the divisor is one for a tap and its mirror image.
template <bool kRelative>
HWY_INLINE void sloped_as(const quell_run& run, const float* depth, const float* slope_x, const float* slope_y,
                          DepthFalloff f, float* exponent) {
  const V sigma = all(f.sigma / kLog2E), epsilon = all(f.epsilon / kLog2E);  // e to powers of 2
  each_pair(run, exponent, [=](auto p) HWY_ATTR {
    const V z = p(depth), sx = p(slope_x), sy = p(slope_y);
    const V least = kRelative ? epsilon * scale_of(z) : epsilon;
    return [=](Offset o) HWY_ATTR {
      const V change = hn::Abs(mul_add(sx, o.dx, sy * o.dy));
      const V k = reciprocal(mul_add(sigma, change, least));
      return [=](auto q) HWY_ATTR { return hn::Abs(q(depth) - z) * k; };
    };
  });
}
void sloped(const quell_run& run, const float* depth, const float* slope_x, const float* slope_y, DepthFalloff f,
            float* exponent) {
  f.relative ? sloped_as<true>(run, depth, slope_x, slope_y, f, exponent)
             : sloped_as<false>(run, depth, slope_x, slope_y, f, exponent);
}

// |z - z'| / sigma, or / (sigma · z).
template <bool kRelative>
HWY_INLINE void plain_as(const quell_run& run, const float* depth, DepthFalloff f, float* exponent) {
  const V scale = all(kLog2E / f.sigma);
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V z = p(depth);
    const V k = kRelative ? scale / scale_of(z) : scale;
    return [=](auto q) HWY_ATTR { return hn::Abs(q(depth) - z) * k; };
  });
}
void plain(const quell_run& run, const float* depth, DepthFalloff f, float* exponent) {
  f.relative ? plain_as<true>(run, depth, f, exponent) : plain_as<false>(run, depth, f, exponent);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(sloped);
HWY_EXPORT(plain);

void depth_weigh_sloped(const quell_run& run, const float* depth, const float* slope_x, const float* slope_y,
                        DepthFalloff f, float* exponent) {
  HWY_DYNAMIC_DISPATCH(sloped)(run, depth, slope_x, slope_y, f, exponent);
}
void depth_weigh_plain(const quell_run& run, const float* depth, DepthFalloff f, float* exponent) {
  HWY_DYNAMIC_DISPATCH(plain)(run, depth, f, exponent);
}

}  // namespace quell
#endif
