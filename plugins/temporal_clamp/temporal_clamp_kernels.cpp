// Clamps rows of history into the ranges of the current frame's windows.
#include "temporal_clamp/temporal_clamp_kernels.h"

#include "outlier_clamp/window.h"

QUELL_SIMD_BEGIN

void history_row(const WindowRange& w, int y, int x0, int x1, const float* history, float* out) {
  ranges(w, y, x0, x1);
  for (int x = x0; x < x1; x += kLanes) store(into_range(load(history + x), w, x - x0), out + x, x1 - x);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(history_row);

void clamp_history(const WindowRange& w, int y, int x0, int x1, const float* history, float* out) {
  HWY_DYNAMIC_DISPATCH(history_row)(w, y, x0, x1, history, out);
}

}  // namespace quell
#endif
