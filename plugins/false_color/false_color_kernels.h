// The kernel of false_color.
#pragma once

#include <cstdint>

namespace quell {

enum class ColorMap : std::int32_t { turbo, grey };

struct ColorScale {
  ColorMap map = ColorMap::turbo;
  bool logarithmic = false;
  float low = 0, high = 1;
};

// Pixels [x0, x1) of rows at pixel x = 0. `stops` moves a logarithmic scale.
void color_row(const ColorScale&, float stops, int x0, int x1, const float* in, float* const out[3]);

}  // namespace quell
