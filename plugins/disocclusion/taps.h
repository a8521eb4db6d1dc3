// How an image of type taps is laid out, and a row of one beside the motion that it validates.
#pragma once

#include <quell/tile.h>

#include <cstddef>
#include <cstdint>

namespace quell {

// Plane of the mask; the four before it are the weights NW, NE, SW, SE.
inline constexpr int kTapsMask = 4;
// Bits 0 to 8: the valid pixels of the 3x3 around the nearest one, row by row.
inline constexpr std::uint32_t kTapsAround = 0x1FF;
// Bit 9: all of the 4x4 around the position is valid.
inline constexpr std::uint32_t kTapsWhole = 1u << 9;

// Row y, at pixel x = 0, and the shape of the history that it leads into.
struct TapsRow {
  const float *motion[2], *weight[4];
  const std::uint32_t* mask;
  int width, height, y;
  std::ptrdiff_t pitch;
};

inline TapsRow taps_row(const Tile& tile, In<Motion> motion, In<Taps> taps, const quell_image& history, int y) {
  TapsRow row{};
  for (int c = 0; c < 2; ++c) row.motion[c] = tile.row(motion, c, y);
  for (int t = 0; t < 4; ++t) row.weight[t] = tile.row(taps, t, y);
  row.mask = tile.bits(taps, kTapsMask, y);
  row.width = history.width, row.height = history.height, row.y = y, row.pitch = history.pitch;
  return row;
}

}  // namespace quell
