// Clamps rows into the ranges of their windows.
#include "outlier_clamp/outlier_clamp_kernels.h"

#include "outlier_clamp/window.h"

QUELL_SIMD_BEGIN

void channel(const WindowRange& w, int y, int x0, int x1, float* out) {
  ranges(w, y, x0, x1);
  const float* in = w.plane + y * w.pitch;
  for (int x = x0; x < x1; x += kLanes) store(into_range(load(in + x), w, x - x0), out + x, x1 - x);
}

void by_luminance(const WindowRange& w, int y, int x0, int x1, const float* const* in, float* const* out) {
  ranges(w, y, x0, x1);
  for (int x = x0; x < x1; x += kLanes) {
    const V l = load(w.plane + y * w.pitch + x), to = into_range(l, w, x - x0);
    const M changes = hn::And(l > zero(), to != l);
    for (int c = 0; c < 3; ++c) {
      const V v = load(in[c] + x);
      store(hn::IfThenElse(changes, v * (to / l), v), out[c] + x, x1 - x);
    }
  }
}

void luminances(const float* const* in, int x0, int x1, float* out) {
  for (int x = x0; x < x1; x += kLanes)
    store(luminance(load(in[0] + x), load(in[1] + x), load(in[2] + x)), out + x, x1 - x);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(channel);
HWY_EXPORT(by_luminance);
HWY_EXPORT(luminances);

void clamp_channel(const WindowRange& w, int y, int x0, int x1, float* out) {
  HWY_DYNAMIC_DISPATCH(channel)(w, y, x0, x1, out);
}
void clamp_luminance(const WindowRange& w, int y, int x0, int x1, const float* const in[3], float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(by_luminance)(w, y, x0, x1, in, out);
}
void luminance_row(const float* const in[3], int x0, int x1, float* out) {
  HWY_DYNAMIC_DISPATCH(luminances)(in, x0, x1, out);
}

}  // namespace quell
#endif
