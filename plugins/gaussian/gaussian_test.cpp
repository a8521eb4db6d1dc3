// gaussian against two-dimensional sums in double precision.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

double choose(int n, int k) { return std::tgamma(n + 1) / (std::tgamma(k + 1) * std::tgamma(n - k + 1)); }

TEST(Gaussian, EqualsTheTwoDimensionalSum) {
  struct Case {
    const char* kernel;
    float sigma;
    int radius, reach;
  };
  for (const auto& [kernel, sigma, radius, reach] : {Case{"gaussian", 1.2f, 0, 4},
                                                     {"gaussian", 3.0f, 5, 5},
                                                     {"binomial", 1, 1, 1},
                                                     {"binomial", 1, 4, 4},
                                                     {"box", 1, 3, 3},
                                                     {"box", 1, 0, 0}})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {150, 21}}) {
      SCOPED_TRACE(testing::Message() << kernel << " " << radius << " " << width << "x" << height);
      const auto image = noise_image(width, height, 3, 61);
      Node node("gaussian");
      node.set("kernel", kernel).set("sigma", sigma).set("radius", radius).in("image", image);
      const auto along = [=, name = kernel[1]](int i) {
        return name == 'a'   ? std::exp(-i * i / (2.0 * sigma * sigma))
               : name == 'i' ? choose(2 * reach, reach + i)
                             : 1.0;
      };
      const FilterOracle expected{reach, 1, [&](int dx, int dy) { return along(dx) * along(dy); }, {}};
      for_each_target([&] {
        EXPECT_LE(
            largest_difference(node.run("image"), [&](int c, int x, int y) { return expected.mean(image, c, x, y); }),
            1e-6);
      });
    }
}

// Golden half kernel of sigma 2, radius 6.
TEST(Gaussian, ImpulseGivesTheKernel) {
  Image impulse(31, 31, 1);
  for (int y = 0; y < 31; ++y) impulse.at(0, 15, y) = 1;
  Node node("gaussian");
  const auto out = node.set("sigma", 2.0f).in("image", impulse).run("image");
  const double half[] = {0.19967563, 0.17621312, 0.12110939, 0.06482519, 0.02702316, 0.00877313, 0.0022182, 0};
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(out.at(0, 15 + i, 15), half[i], 1e-7);
    EXPECT_NEAR(out.at(0, 15 - i, 15), half[i], 1e-7);
  }
}

// Blurs add like variances: sigma 3 then 4 is sigma 5.
TEST(Gaussian, TwoPassesAreOne) {
  Image impulse(101, 3, 1);
  for (int y = 0; y < 3; ++y) impulse.at(0, 50, y) = 1;
  Node first("gaussian"), second("gaussian"), once("gaussian");
  const auto half = first.set("sigma", 3.0f).in("image", impulse).run("image");
  const auto twice = second.set("sigma", 4.0f).in("image", half).run("image");
  const auto expected = once.set("sigma", 5.0f).in("image", impulse).run("image");
  EXPECT_LE(largest_difference(twice, [&](int c, int x, int y) { return double(expected.at(c, x, y)); }),
            1e-2 * expected.at(0, 50, 1));
}

TEST(Gaussian, WideKernelOnASmallImage) {
  const auto image = noise_image(40, 30, 1, 62);
  Node node("gaussian");
  const auto out = node.set("sigma", 64.0f).in("image", image).run("image");
  const FilterOracle expected{
      192, 1, [](int dx, int dy) { return std::exp(-(dx * dx + dy * dy) / (2.0 * 64 * 64)); }, {}};
  for (const auto& [x, y] : {std::pair{0, 0}, {39, 29}, {20, 10}})
    EXPECT_NEAR(out.at(0, x, y), expected.mean(image, 0, x, y), 1e-6);
}

TEST(Gaussian, SameBitsForAnyTiles) {
  const auto image = noise_image(333, 40, 3, 63);
  Node node("gaussian");
  node.set("sigma", 4.0f).in("image", image);
  const auto whole = node.run("image");
  for (const auto& [rows, columns] : {std::pair{1, 0}, {7, 50}, {40, 129}})
    EXPECT_TRUE(same_bits(whole, node.tiles(rows, columns).run("image"))) << rows << "x" << columns;
}

}  // namespace
}  // namespace quell::test
