// Kernels of separable: the gather engine where there are weights, else a convolution, which is all that is left.
#pragma once

#include <quell/taps.h>

#include <vector>

namespace quell {

void separable_tile(const Gather&, const quell_tile&, const quell_image& out);

struct Convolution {
  int radius;
  std::vector<float> kernel;   // 2 radius + 1 weights
  std::vector<float> inverse;  // for each column or row of the tile, and kPad more: 1 / sum of the weights in the image

  static constexpr int kPad = 128;  // vectors are worked on whole, eight at a time
};

void convolve_rows(const Convolution&, const quell_tile&, const quell_image& in, const quell_image& out);
void convolve_columns(const Convolution&, const quell_tile&, const quell_image& in, const quell_image& out);

}  // namespace quell
