// The factor against its formula, and where it is 0 and 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

double luma(const Image& image, int x, int y, bool compress) {
  const auto at = [&](int c) { return compress ? std::log1p(double(image.at(c, x, y))) : double(image.at(c, x, y)); };
  return (at(0) + 2 * at(1) + at(2)) / 4;
}

// A distance to the range's end loses as many digits as it is smaller than luma; the share of it is off by that over
// the width of the range, about 1 here.
TEST(AntiFlicker, IsItsFormula) {
  for_each_target([&] {
    for (const auto& [width, height, radius, k] : {std::tuple{33, 17, 1, 1.0f}, {17, 3, 3, 0.5f}, {1, 7, 2, 1.0f}})
      for (const bool compress : {false, true}) {
        const auto current = noise_image(width, height, 3, 1, 0, 4), history = noise_image(width, height, 3, 2, 0, 6);
        const auto out = Node("anti_flicker")
                             .set("radius", radius)
                             .set("k", k)
                             .set("compress", compress)
                             .in("history", history)
                             .in("current", current)
                             .run("factor");
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            double n = 0, mean = 0, squares = 0;
            const auto each = [&](auto&& use) {
              for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
                for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u)
                  use(luma(current, u, v, compress));
            };
            each([&](double v) { ++n, mean += v; });
            mean /= n;
            each([&](double v) { squares += (v - mean) * (v - mean); });
            const double reach = double(k) * std::sqrt(squares / n), then = luma(history, x, y, compress);
            const double d = std::min(std::abs(mean - reach - then), std::abs(mean + reach - then));
            EXPECT_NEAR(out.at(0, x, y), d / (d + 2 * reach), 5e-6) << x << ',' << y;
          }
      }
  });
}

TEST(AntiFlicker, IsOneWhereNothingVaries) {
  for_each_target([&] {
    const auto image = constant_image(17, 3, 3, 0.3f), other = constant_image(17, 3, 3, 9);
    for (const auto* history : {&image, &other}) {
      const auto out = Node("anti_flicker").in("history", *history).in("current", image).run("factor");
      for (int x = 0; x < 17; ++x) EXPECT_EQ(out.at(0, x, 1), 1);
    }
  });
}

}  // namespace
