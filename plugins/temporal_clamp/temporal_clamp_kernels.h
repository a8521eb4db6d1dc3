// The kernels of temporal_clamp: the box of each pixel, and history pulled into it.
#pragma once

#include <cstdint>

#include "outlier_clamp/window_range.h"

namespace quell {

enum class Box : std::int32_t { sigma, range };
enum class Pull : std::int32_t { clamp, clip };
enum class Space : std::int32_t { linear, ycocg };

struct PullRules {
  Box box;
  Pull pull;
  Space space;
  bool compress, hold_center;
  // Whether the box is in another space than the image.
  bool converts() const { return compress || space != Space::linear; }
};

// Fill low and high for pixels [x0, x1) of row y, from index 0: mean ± k·sigma, or the least and the largest value, for
// which each of `columns` has room for the tile and the window on both sides.
void window_sigmas(const WindowRange&, int y, int x0, int x1);
void window_extremes(const WindowRange&, float* const columns[2], int y, int x0, int x1);

// Pixels [x0, x1) of a row of all channels, from the image's space to the box's.
void convert_row(const PullRules&, int channels, const float* const* from, float* const* to, int x0, int x1);

// One row of all channels; all pointers at pixel x = 0.
struct PullRow {
  PullRules rules;
  int channels;
  const float* const* history;
  const float *const *low, *const *high;
  const float* const* current;  // in the space of the box
  float* const* out;
  float *const *converted, *const *pulled;  // room for history in the space of the box, before and after
};
void pull_history(const PullRow&, int x0, int x1);

}  // namespace quell
