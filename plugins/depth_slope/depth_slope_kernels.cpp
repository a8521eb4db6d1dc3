// Slopes of a row of depths.
#include "depth_slope/depth_slope_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

constexpr float kFarDepth = 1e30f;
// On a plane, 1/depth is linear in the pixel, so the two one-sided differences differ by about slope / depth of their
// sum. A quarter is far above that for all but grazing surfaces, and below any crease that is worth keeping.
constexpr float kBend = 0.25f;

HWY_INLINE M hits(V z) { return z < all(0.5f * kFarDepth); }

HWY_INLINE V slope_of(V before, V here, V after) {
  const V left = here - before, right = after - here;
  const V steep_left = hn::Abs(left), steep_right = hn::Abs(right);
  const M smooth = hn::Abs(right - left) <= all(kBend) * (steep_left + steep_right);
  const V flatter = hn::IfThenElse(steep_left <= steep_right, left, right);
  const V inside = hn::IfThenElse(smooth, all(0.5f) * (left + right), flatter);
  const M hit_before = hits(before), hit_after = hits(after);
  const V one_sided = hn::IfThenElse(hit_before, left, hn::IfThenElseZero(hit_after, right));
  return hn::IfThenElseZero(hits(here), hn::IfThenElse(hn::And(hit_before, hit_after), inside, one_sided));
}

void slopes(const float* above, const float* here, const float* below, int width, int x0, int x1, float* dx,
            float* dy) {
  const V far = all(kFarDepth), first = zero(), last = all(float(width - 1));
  for (int x = x0; x < x1; x += kLanes) {
    const V z = load(here + x), column = lane_numbers() + all(float(x));
    const V left = hn::IfThenElse(column == first, far, load(here + x - 1));
    const V right = hn::IfThenElse(column == last, far, load(here + x + 1));
    store(slope_of(left, z, right), dx + x, x1 - x);
    store(slope_of(above ? load(above + x) : far, z, below ? load(below + x) : far), dy + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(slopes);

void slope_row(const float* above, const float* here, const float* below, int width, int x0, int x1, float* dx,
               float* dy) {
  HWY_DYNAMIC_DISPATCH(slopes)(above, here, below, width, x0, x1, dx, dy);
}

}  // namespace quell
#endif
