// Where a pixel was in the previous frame: the one reading of motion that disocclusion, reproject and history_length
// share.
#pragma once

#include <cmath>
#include <cstdint>

namespace quell {

struct Footprint {
  bool inside;               // the previous position lies in the image; if not, nothing else is set
  int x, y;                  // north-west of the four bilinear taps; may be -1
  float fx, fy;              // position between them, [0, 1]
  int nearest_x, nearest_y;  // the pixel that contains the position
};

// Positions are those of pixel centres, so pixel x is at x: previous = x + motion, inside where it is in [-1/2, size -
// 1/2).
inline Footprint footprint(int x, int y, float motion_x, float motion_y, int width, int height) {
  const float px = float(x) + motion_x, py = float(y) + motion_y;
  if (!(px >= -0.5f && px < float(width) - 0.5f && py >= -0.5f && py < float(height) - 0.5f)) return {};  // NaN too
  const float bx = std::floor(px), by = std::floor(py), fx = px - bx, fy = py - by;
  return {true, int(bx), int(by), fx, fy, int(bx) + (fx >= 0.5f), int(by) + (fy >= 0.5f)};
}

// Planes of an image of type taps: the weights NW, NE, SW, SE and the mask.
inline constexpr int kTapMask = 4;
// Bits 0 to 8 of the mask: the valid pixels of the 3x3 around the nearest one, row by row.
inline constexpr std::uint32_t kAround = 0x1FF;
// Bit 9: all of the 4x4 around the position is valid.
inline constexpr std::uint32_t kWhole = 1u << 9;

}  // namespace quell
