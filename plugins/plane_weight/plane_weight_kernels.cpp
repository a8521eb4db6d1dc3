// Exponents of plane_weight, two vectors of pixels a step.
#include "plane_weight/plane_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

// D is the neighbour's distance from the centre's tangent plane, or that distance over the one to
// the centre: the sine of the neighbour's elevation, which needs no scale. A miss is told by its normal alone: what its
// position holds is anybody's guess.
template <bool kSine, class F>
HWY_INLINE void weigh_plane(const quell_run& run, PlaneGuides s, float sigma, float* exponent) {
  const V scale = all(F::kUnitSquared / (sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V x = p(s.x), y = p(s.y), z = p(s.z), nx = p(s.nx), ny = p(s.ny), nz = p(s.nz);
    const V miss = hn::VecFromMask(d, all_zero(nx, ny, nz));
    return [=](auto q) HWY_ATTR {
      const V dx = q(s.x) - x, dy = q(s.y) - y, dz = q(s.z) - z;
      const V away = mul_add(nx, dx, mul_add(ny, dy, nz * dz));
      V squared = away * away;
      // The least distance that counts, 1e-15, only keeps 0/0 out: points that coincide lie in the plane.
      if constexpr (kSine)
        squared = squared * reciprocal(hn::Max(mul_add(dx, dx, mul_add(dy, dy, dz * dz)), all(1e-30f)));
      const M here = hn::MaskFromVec(miss), there = all_zero(q(s.nx), q(s.ny), q(s.nz));
      const V surfaces = hn::IfThenZeroElse(here, F::of_square(squared * scale));
      return hn::IfThenElse(hn::Xor(here, there), all(HUGE_VALF), surfaces);
    };
  });
}
void sine(const quell_run& run, PlaneGuides s, Falloff falloff, float sigma, float* exponent) {
  with_falloff(falloff, [&](auto f) HWY_ATTR { weigh_plane<true, decltype(f)>(run, s, sigma, exponent); });
}
void distance(const quell_run& run, PlaneGuides s, Falloff falloff, float sigma, float* exponent) {
  with_falloff(falloff, [&](auto f) HWY_ATTR { weigh_plane<false, decltype(f)>(run, s, sigma, exponent); });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(sine);
HWY_EXPORT(distance);

void plane_weigh_sine(const quell_run& run, PlaneGuides s, Falloff falloff, float sigma, float* exponent) {
  HWY_DYNAMIC_DISPATCH(sine)(run, s, falloff, sigma, exponent);
}
void plane_weigh_distance(const quell_run& run, PlaneGuides s, Falloff falloff, float sigma, float* exponent) {
  HWY_DYNAMIC_DISPATCH(distance)(run, s, falloff, sigma, exponent);
}

}  // namespace quell
#endif
