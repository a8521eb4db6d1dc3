// The kernel of outlier_rank.
#pragma once

#include <cstddef>

namespace quell {

struct RankWindow {
  float* const* plane;  // R, G, B
  const float* id;      // uint32, or null: all neighbours count
  std::ptrdiff_t pitch;
  int width, height, radius;
};

// Pixels [x0, x1) of row y; rank from 1 to 4. Rows at pixel x = 0.
void select_by_rank(const RankWindow&, int rank, int y, int x0, int x1, float* const out[3]);

}  // namespace quell
