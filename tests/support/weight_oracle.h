// Weight nodes and filters over them as formulas in double precision: what the kernels are held against.
#pragma once

#include "tests/support/run_node.h"

#include <functional>
#include <vector>

namespace quell::test {

// Weight of the tap (x + dx, y + dy) seen from (x, y).
using WeightFormula = std::function<double(int x, int y, int dx, int dy)>;

// Weights that a weight node gives to taps, by its own weigh: [tap][pixel of the row], 0 outside the image. `paired`
// taps are mirrored pairs.
std::vector<std::vector<double>> weights_of(Node& weight, int width, int height, int y,
                                            const std::vector<std::pair<int, int>>& offsets, bool paired);

// Holds a weight node against its formula at every pixel and many taps, on every target, alone and on top of exponents
// that are there already. A weight may differ by `tolerance`.
void check_weight(Node& weight, int width, int height, const WeightFormula&, double tolerance);

// Σ kernel·w·v / Σ kernel·w over (dx, dy)·step with |dx|, |dy| <= radius inside the image; the centre has weight
// kernel(0, 0).
struct FilterOracle {
  int radius = 1, step = 1;
  std::function<double(int dx, int dy)> kernel = [](int, int) { return 1.0; };
  std::vector<WeightFormula> weights;

  double weight(int x, int y, int dx, int dy) const;
  double mean(const Image&, int channel, int x, int y) const;
  double variance(const Image&, int x, int y) const;
};

// Largest difference between an image and a formula of (channel, x, y).
double largest_difference(const Image&, const std::function<double(int channel, int x, int y)>&);

}  // namespace quell::test
