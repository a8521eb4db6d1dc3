// Caps luminance, a vector of windows at once.
#include "luminance_cap/luminance_cap_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

void luminance_row(const float* const* in, int x0, int x1, float* out) {
  for (int x = x0; x < x1; x += kLanes)
    store(luminance(load(in[0] + x), load(in[1] + x), load(in[2] + x)), out + x, x1 - x);
}

// Calls visit with each neighbour of the pixels from x on, and which of them lie in the image.
template <class Visit>
HWY_INLINE void each_neighbour(const CapWindow& w, int y, int x, Visit visit) {
  const int top = y < w.radius ? 0 : y - w.radius, bottom = y + w.radius < w.height ? y + w.radius : w.height - 1;
  const V column = lane_numbers() + all(float(x));
  for (int v = top; v <= bottom; ++v)
    for (int dx = -w.radius; dx <= w.radius; ++dx) {
      if (v == y && dx == 0) continue;
      const V u = column + all(float(dx));
      visit(load(w.luminance + v * w.pitch + x + dx), hn::And(u >= zero(), u < all(float(w.width))));
    }
}

template <int kRank>
HWY_INLINE V brightest(const CapWindow& w, int y, int x) {
  V list[kRank];
  for (V& kept : list) kept = all(-HUGE_VALF);
  each_neighbour(w, y, x, [&](V l, M inside) HWY_ATTR {
    V rest = hn::IfThenElse(inside, l, all(-HUGE_VALF));
    for (V& kept : list) {
      const V less = hn::Min(kept, rest);
      kept = hn::Max(kept, rest);
      rest = less;
    }
  });
  return list[kRank - 1];
}
HWY_INLINE V mean(const CapWindow& w, int y, int x) {
  V sum = zero(), count = zero();
  each_neighbour(w, y, x, [&](V l, M inside) HWY_ATTR {
    sum = sum + hn::IfThenElseZero(inside, l);
    count = count + hn::IfThenElseZero(inside, all(1.0f));
  });
  return hn::IfThenElse(count > zero(), sum / hn::Max(count, all(1.0f)), all(-HUGE_VALF));
}

void cap_row(const CapWindow& w, int y, int x0, int x1, const float* const* in, float* const* out) {
  for (int x = x0; x < x1; x += kLanes) {
    const V l = load(w.luminance + y * w.pitch + x);
    const V of = w.rank == 0   ? mean(w, y, x)
                 : w.rank == 1 ? brightest<1>(w, y, x)
                 : w.rank == 2 ? brightest<2>(w, y, x)
                 : w.rank == 3 ? brightest<3>(w, y, x)
                               : brightest<4>(w, y, x);
    const V cap = of * all(w.scale);
    // Of minus infinity there are too few neighbours to say.
    const M too_bright = hn::And(hn::And(l > cap, l > zero()), of > all(-HUGE_VALF));
    const V share = hn::Max(cap, zero()) / l;
    for (int c = 0; c < 3; ++c) {
      const V v = load(in[c] + x);
      store(hn::IfThenElse(too_bright, v * share, v), out[c] + x, x1 - x);
    }
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(luminance_row);
HWY_EXPORT(cap_row);

void luminances(const float* const in[3], int x0, int x1, float* out) {
  HWY_DYNAMIC_DISPATCH(luminance_row)(in, x0, x1, out);
}
void cap_luminance(const CapWindow& w, int y, int x0, int x1, const float* const in[3], float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(cap_row)(w, y, x0, x1, in, out);
}

}  // namespace quell
#endif
