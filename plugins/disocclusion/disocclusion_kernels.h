// What the kernel of disocclusion is given: one row of a tile, and the previous frame in full.
#pragma once

#include <cstddef>
#include <cstdint>

namespace quell {

enum class TapMode : std::int32_t { bilinear, nearest };

struct TapRules {
  TapMode mode;
  bool fallback;
  float depth_tolerance, depth_floor, normal_cosine, plane_tolerance;
};

// Rows of this frame at pixel x = 0, planes of the previous one at pixel (0, 0). nullptr: not connected.
struct TapGuides {
  const float* motion[2];
  const float* slope[2];
  const float *depth, *depth_before;
  const float *normal[3], *normal_before[3];
  const float *position[3], *position_before[3];  // only with normal and depth
  const std::uint32_t *id, *id_before;
  int width, height;
  std::ptrdiff_t pitch;
};

// Weights and mask of pixels [x0, x1) of row y; the outputs point at pixel x = 0.
void validate_taps(const TapGuides&, const TapRules&, int y, int x0, int x1, float* const weight[4],
                   std::uint32_t* mask);

}  // namespace quell
