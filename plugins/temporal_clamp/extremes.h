// Least and largest value of the square window around each pixel, cut off at the image border. For *_kernels.cpp only.

#include <quell/simd.h>

#if defined(QUELL_EXTREMES_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_EXTREMES_H_
#undef QUELL_EXTREMES_H_
#else
#define QUELL_EXTREMES_H_
#endif

#include "outlier_clamp/window_range.h"

QUELL_SIMD_BEGIN

// Fills low and high for pixels [x0, x1) of row y, from index 0: over columns, whose extremes go to `columns`, then
// along the row.
HWY_INLINE void extremes(const WindowRange& w, float* const* columns, int y, int x0, int x1) {
  const int left = x0 - w.radius, right = x1 + w.radius;
  const int from = left < 0 ? 0 : left, to = right > w.width ? w.width : right;
  const int top = y < w.radius ? 0 : y - w.radius, bottom = y + w.radius < w.height ? y + w.radius + 1 : w.height;
  float *const least = columns[0], *const most = columns[1];
  const auto nothing = [&](int u) HWY_ATTR { least[u - left] = HUGE_VALF, most[u - left] = -HUGE_VALF; };
  for (int u = left; u < from; ++u) nothing(u);
  for (int u = to; u < right; ++u) nothing(u);
  for (int u = from; u < to; u += kLanes) {
    V low = all(HUGE_VALF), high = all(-HUGE_VALF);
    for (int v = top; v < bottom; ++v) {
      const V value = load(w.plane + v * w.pitch + u);
      low = hn::Min(low, value), high = hn::Max(high, value);
    }
    store(low, least + u - left, to - u);
    store(high, most + u - left, to - u);
  }
  for (int i = 0; i < x1 - x0; i += kLanes) {
    V low = all(HUGE_VALF), high = all(-HUGE_VALF);
    for (int t = 0; t <= 2 * w.radius; ++t)
      low = hn::Min(low, load(least + i + t)), high = hn::Max(high, load(most + i + t));
    store(low, w.low + i);
    store(high, w.high + i);
  }
}

QUELL_SIMD_END
#endif
