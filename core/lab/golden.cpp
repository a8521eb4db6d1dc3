// Counts the pixels that differ from a golden image.
#include "core/lab/golden.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quell {

namespace {

double shown(float x) { return x > -1 ? double(x) / (1 + double(x)) : -1e30; }

}  // namespace

GoldenDifference compare_golden(const quell_image& picture, const quell_image& golden, const GoldenTolerance& t) {
  GoldenDifference d;
  d.pixels = std::size_t(picture.width) * std::size_t(picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      double most = 0;
      for (int c = 0; c < picture.channels; ++c)
        most = std::max(most, std::abs(shown(picture.plane[c][y * picture.pitch + x]) -
                                       shown(golden.plane[c][y * golden.pitch + x])));
      if (most > t.pixel) ++d.others;
      if (most > d.largest) d.largest = most, d.x = x, d.y = y;
    }
  return d;
}

std::string GoldenDifference::problem(const GoldenTolerance& t) const {
  const std::string where = fmt::format("the largest difference is {:.4g}, at {},{}", largest, x, y);
  if (double(others) > t.share * double(pixels))
    return fmt::format("{} of {} pixels ({:.3g} %) differ by more than {:.4g}, and {:.3g} % may; {}", others, pixels,
                       100.0 * double(others) / double(pixels), t.pixel, 100 * t.share, where);
  return largest > t.limit ? fmt::format("no pixel may differ by more than {:.4g}; {}", t.limit, where) : "";
}

}  // namespace quell
