// Variance over time where there is enough of it, else over space.
#include "variance_estimate/variance_estimate_kernels.h"

#include <quell/gather.h>

QUELL_SIMD_BEGIN

HWY_INLINE V variance_of(V first, V second) { return hn::Max(hn::NegMulAdd(first, first, second), zero()); }

inline bool any_young(const Estimate& e, std::ptrdiff_t at, int n) {
  for (int i = 0; i < n; i += kLanes) {
    const M young = load(e.count + at + i) < all(e.min_count);
    if (!hn::AllFalse(d, hn::And(young, hn::FirstN(d, std::size_t(n - i))))) return true;
  }
  return false;
}

inline void by_time(const Estimate& e, std::ptrdiff_t at, int n) {
  for (int i = 0; i < n; i += kLanes) {
    for (std::size_t c = 0; c < 3; ++c) store(load(e.gather.planes[c] + at + i), e.image[c] + at + i, n - i);
    store(variance_of(load(e.gather.planes[3] + at + i), load(e.gather.planes[4] + at + i)), e.variance + at + i,
          n - i);
  }
}

// Blends the means over space in where pixels are young. Few frames tell of less variance than there is: 4 / count
// makes up for it.
inline void by_space(const Estimate& e, Sums& sums, std::ptrdiff_t at, int n) {
  for (int i = 0; i < n; i += kLanes) {
    const V count = load(e.count + at + i), inverse = all(1.0f) / load(sums.weight() + i);
    const M young = count < all(e.min_count);
    for (std::size_t c = 0; c < 3; ++c)
      store(hn::IfThenElse(young, load(sums.plane(c) + i) * inverse, load(e.gather.planes[c] + at + i)),
            e.image[c] + at + i, n - i);
    const V here = variance_of(load(e.gather.planes[3] + at + i), load(e.gather.planes[4] + at + i));
    const V around = variance_of(load(sums.plane(3) + i) * inverse, load(sums.plane(4) + i) * inverse);
    const V boost = all(4.0f) / hn::Max(count, all(1.0f));
    store(hn::IfThenElse(young, around * boost, here), e.variance + at + i, n - i);
  }
}

// The window is taken in blocks of what weight nodes step by at least, for young pixels line the edges of what moved:
// whole segments around them would be ten times their number.
constexpr int kBlock = 32;

void estimate(const Estimate& e, const quell_tile& tile) {
  Sums sums(e.gather.planes.size());
  for_each_segment(tile, 1, e.gather.taps.reach_x, e.gather.width, [&](int x, int y, int n) HWY_ATTR {
    const std::ptrdiff_t at = y * e.gather.pitch + x;
    const auto end_of = [n](int from) HWY_ATTR { return from + kBlock < n ? from + kBlock : n; };
    const auto young = [&](int from) HWY_ATTR { return any_young(e, at + from, end_of(from) - from); };
    for (int from = 0, end; from < n; from = end) {
      end = end_of(from);
      if (!young(from)) {
        by_time(e, at + from, end - from);
        continue;
      }
      while (end < n && young(end)) end = end_of(end);
      gather(e.gather, x + from, y, end - from, sums);
      by_space(e, sums, at + from, end - from);
    }
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(estimate);
void variance_estimate_tile(const Estimate& e, const quell_tile& tile) { HWY_DYNAMIC_DISPATCH(estimate)(e, tile); }

}  // namespace quell
#endif
