// history_fix against its formula in double precision.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

// Frames counted, some of them between whole numbers, as between histories of unlike length.
Image ages(int width, int height) {
  Image count(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      count.at(0, x, y) = x < 100 && (x + y) % 3 ? 1.0f + 0.4f * float((x * 3 + y) % 11) : 20.0f;
  return count;
}

TEST(HistoryFix, IsItsFormula) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {150, 40}})
    for (const bool weighted : {false, true}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height << " weighted " << weighted);
      const auto image = noise_image(width, height, 3, 1), guide = noise_image(width, height, 3, 2),
                 count = ages(width, height);
      Node by_color("color_weight"), node("history_fix");
      by_color.set("sigma", 0.5f).in("image", guide);
      node.in("image", image).in("count", count);
      if (weighted) node.in("weights", by_color);
      for_each_target([&] {
        int young = 0;
        const auto out = node.run("image");
        EXPECT_LE(
            largest_difference(out,
                               [&](int c, int x, int y) {
                                 const double n = count.at(0, x, y);
                                 if (n > 3) return double(image.at(c, x, y));
                                 ++young;
                                 FilterOracle over{2, int(std::lround(14 / (1 + n))), [](int, int) { return 1.0; }, {}};
                                 if (weighted)
                                   over.weights.push_back([&](int u, int v, int dx, int dy) {
                                     double squared = 0;
                                     for (int k = 0; k < 3; ++k)
                                       squared += std::pow(double(guide.at(k, u, v)) - guide.at(k, u + dx, v + dy), 2);
                                     return std::exp(-squared / (2 * 0.5 * 0.5));
                                   });
                                 return over.mean(image, c, x, y);
                               }),
            5e-6);
        EXPECT_GT(young + (width == 1), 0);
      });
    }
}

TEST(HistoryFix, StridesOfTheFirstFrames) {
  for_each_target([&] {
    for (const auto& [n, stride] : {std::pair{1, 7}, {2, 5}, {3, 4}}) {
      // An impulse is seen from as far as two strides, and from nowhere between.
      auto image = constant_image(61, 61, 1, 0);
      image.at(0, 30, 30) = 25;
      const auto count = constant_image(61, 61, 1, float(n));
      const auto out = Node("history_fix").in("image", image).in("count", count).run("image");
      for (int y = 16; y < 45; ++y)
        for (int x = 16; x < 45; ++x) {
          const int dx = std::abs(x - 30), dy = std::abs(y - 30);
          const bool tap = dx % stride == 0 && dy % stride == 0 && dx <= 2 * stride && dy <= 2 * stride;
          EXPECT_FLOAT_EQ(out.at(0, x, y), tap ? 1.0f : 0.0f) << n << ": " << x << ',' << y;
        }
    }
  });
}

TEST(HistoryFix, LeavesOldPixelsAloneToTheBit) {
  for_each_target([&] {
    const auto image = noise_image(77, 13, 5, 1, -1e3f, 1e3f), count = constant_image(77, 13, 1, 3.5f);
    EXPECT_TRUE(same_bits(Node("history_fix").in("image", image).in("count", count).run("image"), image));
    const auto young = constant_image(77, 13, 1, 1);
    EXPECT_TRUE(
        same_bits(Node("history_fix").set("frames", 0).in("image", image).in("count", young).run("image"), image));
  });
}

}  // namespace
}  // namespace quell::test
