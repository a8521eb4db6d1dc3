// Blends rows into their history.
#include "temporal_blend/temporal_blend_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

void blend(const BlendRule& rule, int x0, int x1, const float* current, const float* history, const float* count,
           const float* factor, float* out) {
  const V one = all(1.0f), alpha = all(rule.alpha);
  for (int x = x0; x < x1; x += kLanes) {
    const V n = load(count + x), now = load(current + x), then = load(history + x);
    const V least = factor ? alpha * load(factor + x) : alpha;
    const V a = rule.warm_up ? hn::Max(least, one / hn::Max(n, one)) : least;
    // As a step away from history, so that equal frames stay what they are to the bit.
    const V mixed = mul_add(a, now - then, then);
    store(hn::IfThenElse(hn::And(n > one, a < one), mixed, now), out + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(blend);

void blend_row(const BlendRule& rule, int x0, int x1, const float* current, const float* history, const float* count,
               const float* factor, float* out) {
  HWY_DYNAMIC_DISPATCH(blend)(rule, x0, x1, current, history, count, factor, out);
}

}  // namespace quell
#endif
