// The history clamp against a direct evaluation of its formula.
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

struct Range {
  double low, high;
};

Range range(const Image& image, int c, int x, int y, int radius, double k) {
  double n = 0, mean = 0, squares = 0;
  const auto each = [&](auto&& use) {
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height() - 1); ++v)
      for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width() - 1); ++u)
        use(double(image.at(c, u, v)));
  };
  each([&](double v) { ++n, mean += v; });
  mean /= n;
  each([&](double v) { squares += (v - mean) * (v - mean); });
  const double sigma = std::sqrt(squares / n);
  return {mean - k * sigma, mean + k * sigma};
}

TEST(TemporalClamp, IsItsFormula) {
  for_each_target([&] {
    for (const auto& [width, height, radius, k] : {std::tuple{33, 17, 3, 1.0f}, {17, 3, 2, 0.5f}, {1, 7, 3, 1.0f}}) {
      const auto current = noise_image(width, height, 3, 1), history = noise_image(width, height, 3, 2, -0.5f, 1.5f);
      const auto out = Node("temporal_clamp")
                           .set("radius", radius)
                           .set("k", k)
                           .in("history", history)
                           .in("current", current)
                           .run("image");
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            const auto [low, high] = range(current, c, x, y, radius, k);
            EXPECT_NEAR(out.at(c, x, y), std::clamp(double(history.at(c, x, y)), low, high), 1e-6) << x << ',' << y;
            EXPECT_GE(out.at(c, x, y), low - 1e-6);
            EXPECT_LE(out.at(c, x, y), high + 1e-6);
          }
    }
  });
}

TEST(TemporalClamp, LeavesHistoryAloneWithinAWideRange) {
  for_each_target([&] {
    const auto current = noise_image(17, 5, 2, 1), history = noise_image(17, 5, 2, 2);
    const auto out =
        Node("temporal_clamp").set("k", 1000.0f).in("history", history).in("current", current).run("image");
    for (int c = 0; c < 2; ++c)
      for (int x = 0; x < 17; ++x) EXPECT_EQ(out.at(c, x, 2), history.at(c, x, 2));
  });
}

TEST(TemporalClamp, ReplacesHistoryWhereNothingVaries) {
  for_each_target([&] {
    const auto current = constant_image(17, 5, 3, 0.3f), history = noise_image(17, 5, 3, 2);
    const auto out = Node("temporal_clamp").in("history", history).in("current", current).run("image");
    for (int x = 0; x < 17; ++x) EXPECT_FLOAT_EQ(out.at(1, x, 2), 0.3f);
  });
}

}  // namespace
