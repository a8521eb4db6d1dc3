// Averages counts by validated taps, a vector of pixels at a time.
#include "history_length/history_length_kernels.h"

#include "disocclusion/history.h"

QUELL_SIMD_BEGIN

void count(const TapsRow& row, int x0, int x1, const float* before, float max, float* out) {
  const V one = all(1.0f), most = all(max);
  for (int x = x0; x < x1; x += kLanes) {
    const Support s(row, x, x1 - x);
    V held = zero();
    with_taps(s, row, [&](const auto& tap) HWY_ATTR {
      V value[4], first = zero(), more = zero();
      HWY_UNROLL(4)
      for (int k = 3; k >= 0; --k) {
        value[k] = tap(k, before);
        first = hn::IfThenElse(s.some[k], value[k], first);
      }
      // As differences from one of them, so that equal counts stay whole numbers.
      HWY_UNROLL(4)
      for (int k = 0; k < 4; ++k) more = mul_add(s.weight[k], hn::IfThenElseZero(s.some[k], value[k] - first), more);
      held = first + more;
    });
    if (HWY_UNLIKELY(!hn::AllFalse(d, s.scattered)))
      held = hn::IfThenElse(s.scattered, Neighbourhood(s, row).mean(before), held);
    store(hn::Min(hn::Max(held + one, one), most), out + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(count);

void count_row(const TapsRow& row, int x0, int x1, const float* before, float max, float* out) {
  HWY_DYNAMIC_DISPATCH(count)(row, x0, x1, before, max, out);
}

}  // namespace quell
#endif
