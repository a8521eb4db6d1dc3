// Averages counts by validated taps, a vector of pixels at a time.
#include "history_length/history_length_kernels.h"

#include "disocclusion/history.h"

QUELL_SIMD_BEGIN

void count(const TapsRow& row, int x0, int x1, const float* before, float max, float* out) {
  const V one = all(1.0f), most = all(max);
  for (int x = x0; x < x1; x += kLanes) {
    const Support s = support_at(row, x, x1 - x);
    const TapReader taps(s, row);
    V value[4], first = zero(), more = zero();
    for (int k = 3; k >= 0; --k) {
      value[k] = taps.read(k, before);
      first = hn::IfThenElse(s.some[k], value[k], first);
    }
    // As differences from one of them, so that equal counts stay whole numbers.
    for (int k = 0; k < 4; ++k) more = mul_add(s.weight[k], hn::IfThenElseZero(s.some[k], value[k] - first), more);
    store(hn::Min(hn::Max(first + more + one, one), most), out + x, x1 - x);
    each_scattered(s, x, x1 - x, [&](int u) HWY_ATTR {
      const float n = mean_around(row, before, u) + 1;
      out[u] = n < max ? n : max;
    });
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
