// Kernel of color_weight: exponents from the distance over any number of channels.
#pragma once

#include <quell/abi.h>
#include <quell/falloff.h>

#include <cstdint>

namespace quell {

enum class ColorSpace : std::int32_t { linear, log, sqrt };
struct ColorDistance {
  ColorSpace space;
  Falloff falloff;
  float sigma;
};

void color_weigh(const quell_run&, const float* const* planes, int channels, ColorDistance, float* exponent);

}  // namespace quell
