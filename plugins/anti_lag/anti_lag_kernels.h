// What the kernel of anti_lag is told.
#pragma once

#include <quell/tile.h>

#include <cstddef>
#include <vector>

namespace quell {

struct AntiLag {
  const float* now[3];
  const float* then[3];
  const float* count;
  std::ptrdiff_t pitch;
  int width, height;
  int radius;
  float deviations, strength;
};

void anti_lag_tile(const AntiLag&, const quell_tile&, std::vector<float>& memory, float* out);

}  // namespace quell
