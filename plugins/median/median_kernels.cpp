// Medians of a vector of windows at once, by exchanges that depend on no value.
#include "median/median_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

HWY_INLINE void exchange(V& a, V& b) {
  const V less = hn::Min(a, b);
  b = hn::Max(a, b);
  a = less;
}

// Of an odd number of values. The least and the greatest of any (n + 3) / 2 of them are not the median: they are
// dropped and another value takes their place, until three are left.
template <int kCount>
HWY_INLINE V median_of(V* value) {
  int held = kCount / 2 + 2, next = held;
  for (; held > 2; --held) {
    for (int i = 1; i < held; ++i) exchange(value[0], value[i]);             // the least to the front …
    for (int i = 1; i < held - 1; ++i) exchange(value[i], value[held - 1]);  // … the greatest to the end
    if (next == kCount) return value[1];
    value[0] = value[next++];  // one comes, two go
  }
  return value[0];
}

// Places outside of the image hold -inf and +inf in turn, as many of one as of the other or one -inf more, so that the
// median of all is the (lower) median of those inside.
template <int kRadius>
HWY_INLINE void medians(const MedianWindow& w, int y, int x0, int x1, float* out) {
  constexpr int kSide = 2 * kRadius + 1, kCount = kSide * kSide;
  const V low = all(-HUGE_VALF), high = all(HUGE_VALF);
  for (int x = x0; x < x1; x += kLanes) {
    const bool inside = y >= kRadius && y + kRadius < w.height && x >= kRadius && x + kLanes + kRadius <= w.width;
    V value[kCount];
    const float* from = w.plane + y * w.pitch + x;
    if (inside) {
      for (int i = 0; i < kCount; ++i) value[i] = load(from + (i / kSide - kRadius) * w.pitch + i % kSide - kRadius);
    } else {
      V filler = low, other = high;
      const V column = lane_numbers() + all(float(x));
      for (int i = 0; i < kCount; ++i) {
        const int dy = i / kSide - kRadius, dx = i % kSide - kRadius;
        const bool row = y + dy >= 0 && y + dy < w.height;
        const V u = column + all(float(dx));
        const M in = hn::And(hn::And(u >= zero(), u < all(float(w.width))), row ? zero() == zero() : zero() < zero());
        value[i] = hn::IfThenElse(in, load(row ? from + dy * w.pitch + dx : from), filler);
        const V swapped = hn::IfThenElse(in, filler, other);
        other = hn::IfThenElse(in, other, filler);
        filler = swapped;
      }
    }
    store(median_of<kCount>(value), out + x, x1 - x);
  }
}

void row(const MedianWindow& w, int y, int x0, int x1, float* out) {
  w.radius == 1   ? medians<1>(w, y, x0, x1, out)
  : w.radius == 2 ? medians<2>(w, y, x0, x1, out)
                  : medians<3>(w, y, x0, x1, out);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(row);
void median_row(const MedianWindow& w, int y, int x0, int x1, float* out) {
  HWY_DYNAMIC_DISPATCH(row)(w, y, x0, x1, out);
}

}  // namespace quell
#endif
