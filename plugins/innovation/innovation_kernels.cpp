// Compares pixels with the range of those beside them and of those that they come from.
#include "innovation/innovation_kernels.h"

#include "disocclusion/history.h"

QUELL_SIMD_BEGIN

struct Range {
  V low, high;
  HWY_INLINE Range() : low(all(HUGE_VALF)), high(all(-HUGE_VALF)) {}
  HWY_INLINE void add(V value) { low = hn::Min(low, value), high = hn::Max(high, value); }
  HWY_INLINE V distance(V value) const { return hn::Max(low - value, value - high); }
};

// The largest distance over channels from the eight pixels around.
HWY_INLINE V from_neighbours(const Newness& n, int x) {
  V farthest = zero();
  for (int c = 0; c < n.before.channels; ++c) {
    Range range;
    for (int row = 0; row < 3; ++row)
      for (int i = -1; i <= 1; ++i)
        if (row != 1 || i != 0) range.add(load(n.around[3 * c + row] + x + i));
    farthest = hn::Max(farthest, range.distance(load(n.around[3 * c + 1] + x)));
  }
  return farthest;
}

// The same from the 4x4 that it comes from.
HWY_INLINE V from_past(const Newness& n, const Support& s, int x) {
  V farthest = zero();
  with_square<-1, 4>(s.at, extent_of(n.taps), [&](const auto& square) HWY_ATTR {
    for (int c = 0; c < n.before.channels; ++c) {
      Range range;
      for (int t = 0; t < 16; ++t) range.add(square.read(n.before.plane[c], t % 4, t / 4));
      farthest = hn::Max(farthest, range.distance(load(n.around[3 * c + 1] + x)));
    }
  });
  return farthest;
}

void innovation(const Newness& n, int x0, int x1, float* out) {
  const V free = all(n.tolerance), one = all(1.0f / n.share);
  for (int x = x0; x < x1; x += kLanes) {
    const Support s(n.taps, x, x1 - x);
    M is_new = hn::And(whole_footprints(s, n.taps, x), from_neighbours(n, x) > free);
    if (!hn::AllFalse(d, is_new)) is_new = hn::And(is_new, from_past(n, s, x) > free);
    store(hn::IfThenElseZero(is_new, one), out + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(innovation);
void innovation_row(const Newness& n, int x0, int x1, float* out) { HWY_DYNAMIC_DISPATCH(innovation)(n, x0, x1, out); }

}  // namespace quell
#endif
