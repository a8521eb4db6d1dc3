// Reads history through validated taps.
#pragma once

#include <quell/tile.h>

#include <algorithm>
#include <cstdint>

#include "disocclusion/footprint.h"

namespace quell {

// The history pixels that one pixel averages and their weights, which sum to 1: the validated bilinear taps, or all
// valid pixels of the 3x3 alike where no tap is valid (Schied et al. 2017, section 4.1). Empty where disoccluded.
struct Support {
  int size = 0;
  std::ptrdiff_t at[9];
  float weight[9];
};

inline Support support(const Footprint& f, const float weights[4], std::uint32_t mask, const quell_image& history) {
  Support s;
  if (!f.inside) return s;
  // Clamped, so that taps that do not belong to this motion cannot lead out of the image.
  const auto at = [&](int x, int y) {
    return std::clamp(y, 0, history.height - 1) * history.pitch + std::clamp(x, 0, history.width - 1);
  };
  for (int t = 0; t < 4; ++t)
    if (weights[t] != 0) {
      s.at[s.size] = at(f.x + (t & 1), f.y + (t >> 1));
      s.weight[s.size++] = weights[t];
    }
  if (s.size > 0) return s;
  for (int t = 0; t < 9; ++t)
    if (mask >> t & 1) s.at[s.size++] = at(f.nearest_x + t % 3 - 1, f.nearest_y + t / 3 - 1);
  for (int t = 0; t < s.size; ++t) s.weight[t] = 1.0f / float(s.size);
  return s;
}

// Calls use(x, y, support) for every pixel of the tile.
template <class Use>
void each_support(const Tile& tile, In<Motion> motion, In<Taps> taps, const quell_image& history, Use&& use) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    const float* mx = tile.row(motion, 0, y);
    const float* my = tile.row(motion, 1, y);
    const float* weight[4] = {tile.row(taps, 0, y), tile.row(taps, 1, y), tile.row(taps, 2, y), tile.row(taps, 3, y)};
    const std::uint32_t* mask = tile.bits(taps, kTapMask, y);
    for (int x = tile.x0; x < tile.x1; ++x) {
      const float w[4] = {weight[0][x], weight[1][x], weight[2][x], weight[3][x]};
      use(x, y, support(footprint(x, y, mx[x], my[x], history.width, history.height), w, mask[x], history));
    }
  }
}

}  // namespace quell
