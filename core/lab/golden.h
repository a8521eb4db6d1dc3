// Golden images: what a test's pictures were when they were last looked at and found good.
#pragma once

#include <quell/abi.h>

#include <cstddef>
#include <string>

namespace quell {

// How far a picture may be from its golden one. The difference of a pixel is that of its channels which differs most,
// behind T(x) = x / (1 + x), so that bright pixels count as the eye takes them.
struct GoldenTolerance {
  double pixel = 0.01;  // a pixel that differs by more is another
  double share = 0.0;   // of the pixels that may be others
  double limit = 1.0;   // what no pixel may differ by
};

struct GoldenDifference {
  std::size_t pixels = 0, others = 0;  // of all
  double largest = 0;
  int x = 0, y = 0;  // where it is

  // "" when it is within the tolerance, else in what way it is not.
  std::string problem(const GoldenTolerance&) const;
};

// Both have the same size.
GoldenDifference compare_golden(const quell_image& picture, const quell_image& golden, const GoldenTolerance&);

}  // namespace quell
