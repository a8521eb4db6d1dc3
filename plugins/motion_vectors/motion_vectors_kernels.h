// The kernel of motion_vectors: one row, and what the matrices of its frame say.
#pragma once

#include <cstdint>

namespace quell {

// Motion where there is none to be known. It leads out of any image, so the pixel counts as disoccluded.
inline constexpr float kNoMotion = 1e6f;

// What became of the points of one object, or of the background.
enum class Past { unknown, rest, moved };
struct Journey {
  Past past = Past::unknown;
  double matrix[3][4];  // moved: from a position now to x, y and w of homogeneous pixels one frame earlier
};

// Rows at pixel x = 0.
struct MotionRow {
  int y;
  const float* position[3];  // nullptr: from depth …
  const float* depth;
  double rays[3][3], centre[3], view_z[3];  // … along the ray of pixel (x, y, 1) from the centre, in view direction
  const std::uint32_t* id;                  // nullptr: all are one object, and misses show in depth or position
  const Journey* objects;                   // by id where each has its own, else the first is all objects'
  std::uint32_t count;
  bool each_its_own;
  Journey background;  // of pixel (x, y, 1)
  float* motion[2];
};

void motion_row(const MotionRow&, int x0, int x1);

}  // namespace quell
