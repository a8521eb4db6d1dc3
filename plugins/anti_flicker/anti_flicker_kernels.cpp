// Luma, its range, and how far from the range's ends history lies.
#include "anti_flicker/anti_flicker_kernels.h"

#include "outlier_clamp/window.h"
#include "temporal_clamp/box_space.h"

QUELL_SIMD_BEGIN

void luma(const float* const* in, bool compress, int x0, int x1, float* out) {
  for (int x = x0; x < x1; x += kLanes) {
    V v[3];
    for (int c = 0; c < 3; ++c) v[c] = compress ? compressed(load(in[c] + x)) : load(in[c] + x);
    to_ycocg(v);
    store(v[0], out + x, x1 - x);
  }
}

void flicker(const WindowRange& w, int y, int x0, int x1, const float* then, float* out) {
  ranges(w, y, x0, x1);
  for (int x = x0; x < x1; x += kLanes) {
    const V v = load(then + x), low = load(w.low + x - x0), high = load(w.high + x - x0);
    const V near = hn::Min(hn::Abs(v - low), hn::Abs(v - high)), all_of_it = near + (high - low);
    store(hn::IfThenElse(all_of_it > zero(), hn::Min(near / all_of_it, all(1.0f)), all(1.0f)), out + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(luma);
HWY_EXPORT(flicker);

void luma_row(const float* const in[3], bool compress, int x0, int x1, float* out) {
  HWY_DYNAMIC_DISPATCH(luma)(in, compress, x0, x1, out);
}
void flicker_row(const WindowRange& w, int y, int x0, int x1, const float* then, float* out) {
  HWY_DYNAMIC_DISPATCH(flicker)(w, y, x0, x1, then, out);
}

}  // namespace quell
#endif
