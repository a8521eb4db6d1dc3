// Pulls rows of history into the boxes of the current frame's windows.
#include "temporal_clamp/temporal_clamp_kernels.h"

#include "outlier_clamp/window.h"
#include "temporal_clamp/box_space.h"
#include "temporal_clamp/extremes.h"

QUELL_SIMD_BEGIN

void sigmas(const WindowRange& w, int y, int x0, int x1) { ranges(w, y, x0, x1); }

void least_and_most(const WindowRange& w, float* const* columns, int y, int x0, int x1) {
  extremes(w, columns, y, x0, x1);
}

void convert(const PullRules& rules, int channels, const float* const* from, float* const* to, int x0, int x1) {
  for (int x = x0; x < x1; x += kLanes) {
    if (rules.space == Space::ycocg) {
      V v[3];
      for (int c = 0; c < 3; ++c) v[c] = rules.compress ? compressed(load(from[c] + x)) : load(from[c] + x);
      to_ycocg(v);
      for (int c = 0; c < 3; ++c) store(v[c], to[c] + x, x1 - x);
    } else {
      for (int c = 0; c < channels; ++c) store(compressed(load(from[c] + x)), to[c] + x, x1 - x);
    }
  }
}

// One channel of a box at a vector of pixels.
struct Side {
  HWY_INLINE Side(const PullRow& row, int c, int x) : low(load(row.low[c] + x)), high(load(row.high[c] + x)) {
    if (!row.rules.hold_center) return;
    const V now = load(row.current[c] + x);
    low = hn::Min(low, now), high = hn::Max(high, now);
  }
  HWY_INLINE V middle() const { return all(0.5f) * (high + low); }
  // How far out a value lies, in half-widths, of which there are always some.
  HWY_INLINE V out(V v) const { return hn::Abs(v - middle()) / mul_add(all(0.5f), high - low, all(1e-6f)); }
  V low, high;
};

HWY_INLINE void clamp_into(const PullRow& row, const float* const* from, float* const* to, int x, int count) {
  for (int c = 0; c < row.channels; ++c) {
    const Side side(row, c, x);
    store(hn::Min(hn::Max(load(from[c] + x), side.low), side.high), to[c] + x, count);
  }
}

HWY_INLINE void clip_into(const PullRow& row, const float* const* from, float* const* to, int x, int count) {
  V farthest = zero();
  for (int c = 0; c < row.channels; ++c) farthest = hn::Max(farthest, Side(row, c, x).out(load(from[c] + x)));
  const M outside = farthest > all(1.0f);
  for (int c = 0; c < row.channels; ++c) {
    const Side side(row, c, x);
    const V v = load(from[c] + x), middle = side.middle();
    store(hn::IfThenElse(outside, middle + (v - middle) / farthest, v), to[c] + x, count);
  }
}

// Back into the image's space where something was pulled; the rest is history as it was.
HWY_INLINE void convert_back(const PullRow& row, int x, int count) {
  M moved = zero() > zero();
  for (int c = 0; c < row.channels; ++c) moved = hn::Or(moved, load(row.pulled[c] + x) != load(row.converted[c] + x));
  const auto put = [&](int c, V v) HWY_ATTR {
    if (row.rules.compress) v = expanded(v);
    store(hn::IfThenElse(moved, v, load(row.history[c] + x)), row.out[c] + x, count);
  };
  if (row.rules.space == Space::linear) {
    for (int c = 0; c < row.channels; ++c) put(c, load(row.pulled[c] + x));
    return;
  }
  V v[3];
  for (int c = 0; c < 3; ++c) v[c] = load(row.pulled[c] + x);
  from_ycocg(v);
  for (int c = 0; c < 3; ++c) put(c, hn::Max(v[c], zero()));
}

void pull_row(const PullRow& row, int x0, int x1) {
  const bool converts = row.rules.converts();
  if (converts) convert(row.rules, row.channels, row.history, row.converted, x0, x1);
  const float* const* from = converts ? row.converted : row.history;
  float* const* to = converts ? row.pulled : row.out;
  for (int x = x0; x < x1; x += kLanes) {
    row.rules.pull == Pull::clamp ? clamp_into(row, from, to, x, x1 - x) : clip_into(row, from, to, x, x1 - x);
    if (converts) convert_back(row, x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(sigmas);
HWY_EXPORT(least_and_most);
HWY_EXPORT(convert);
HWY_EXPORT(pull_row);

void window_sigmas(const WindowRange& w, int y, int x0, int x1) { HWY_DYNAMIC_DISPATCH(sigmas)(w, y, x0, x1); }
void window_extremes(const WindowRange& w, float* const columns[2], int y, int x0, int x1) {
  HWY_DYNAMIC_DISPATCH(least_and_most)(w, columns, y, x0, x1);
}
void convert_row(const PullRules& rules, int channels, const float* const* from, float* const* to, int x0, int x1) {
  HWY_DYNAMIC_DISPATCH(convert)(rules, channels, from, to, x0, x1);
}
void pull_history(const PullRow& row, int x0, int x1) { HWY_DYNAMIC_DISPATCH(pull_row)(row, x0, x1); }

}  // namespace quell
#endif
