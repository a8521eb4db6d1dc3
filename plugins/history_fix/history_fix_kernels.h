// The kernel of history_fix: one tile.
#pragma once

#include <quell/taps.h>

namespace quell {

// Pixels from tap to tap for a pixel of this age.
inline int fix_stride(float stride, float count) {
  const float apart = stride / (1.0f + (count > 1.0f ? count : 1.0f));
  return apart < 1.0f ? 1 : int(apart + 0.5f);
}

struct HistoryFix {
  const quell_image& image;
  std::span<const quell_bound_weight> weights;
  const float* count;
  float frames;
  float stride;
  std::vector<TapSet> taps;  // by stride
};

void fix_tile(const HistoryFix&, const quell_tile&, const quell_image& out);

}  // namespace quell
