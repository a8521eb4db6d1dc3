// variance_estimate against its formulas in double precision.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

struct Frame {
  Image image, moments, count;
  Frame(int width, int height)
      : image(noise_image(width, height, 3, 51)), moments(noise_image(width, height, 2, 52)), count(width, height, 1) {
    // Young pixels on the left and sprinkled; some segments have none.
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        count.at(0, x, y) = x < 150 && (x < 40 || (x + 3 * y) % 11 == 0) ? float((x + y) % 5) : 9.0f;
  }
};

TEST(VarianceEstimate, OverTimeOrSpace) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {430, 12}})
    for (const bool weighted : {false, true}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height << " weighted " << weighted);
      const Frame f(width, height);
      Node by_color("color_weight"), node("variance_estimate");
      by_color.set("sigma", 0.5f).in("image", f.image);
      node.in("image", f.image).in("moments", f.moments).in("count", f.count);
      FilterOracle over{3, 1, [](int, int) { return 1.0; }, {}};
      if (weighted) {
        node.in("weights", by_color);
        over.weights.push_back([&](int x, int y, int dx, int dy) {
          double squared = 0;
          for (int c = 0; c < 3; ++c)
            squared += std::pow(double(f.image.at(c, x, y)) - f.image.at(c, x + dx, y + dy), 2);
          return std::exp(-squared / (2 * 0.5 * 0.5));
        });
      }
      for_each_target([&] {
        const auto out = node.run();
        EXPECT_LE(largest_difference(out[0],
                                     [&](int c, int x, int y) {
                                       return f.count.at(0, x, y) < 4 ? over.mean(f.image, c, x, y)
                                                                      : f.image.at(c, x, y);
                                     }),
                  5e-6);
        EXPECT_LE(largest_difference(out[1],
                                     [&](int, int x, int y) {
                                       const double n = f.count.at(0, x, y);
                                       const bool young = n < 4;
                                       const double m1 = young ? over.mean(f.moments, 0, x, y) : f.moments.at(0, x, y);
                                       const double m2 = young ? over.mean(f.moments, 1, x, y) : f.moments.at(1, x, y);
                                       return std::max(0.0, m2 - m1 * m1) * (young ? 4 / std::max(n, 1.0) : 1);
                                     }),
                  2e-5);
      });
    }
}

// Without young pixels the image passes through bit for bit.
TEST(VarianceEstimate, OldPixelsAreLeftAlone) {
  const Frame f(200, 9);
  const auto count = constant_image(200, 9, 1, 4.0f);
  Node node("variance_estimate");
  const auto out = node.in("image", f.image).in("moments", f.moments).in("count", count).run("image");
  EXPECT_TRUE(same_bits(out, f.image));
}

TEST(VarianceEstimate, SameBitsForAnyTiles) {
  const Frame f(333, 30);
  Node node("variance_estimate");
  node.set("radius", 5).in("image", f.image).in("moments", f.moments).in("count", f.count);
  const auto whole = node.run();
  for (const auto& [rows, columns] : {std::pair{1, 0}, {7, 50}, {40, 129}}) {
    const auto tiled = node.tiles(rows, columns).run();
    EXPECT_TRUE(same_bits(whole[0], tiled[0]) && same_bits(whole[1], tiled[1])) << rows << "x" << columns;
  }
}

}  // namespace
}  // namespace quell::test
