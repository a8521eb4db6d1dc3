// window against weighted sums in double precision.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

WeightFormula by_color_formula(const Image& color, double sigma) {
  return [&color, sigma](int x, int y, int dx, int dy) {
    double squared = 0;
    for (int c = 0; c < color.channels(); ++c)
      squared += std::pow(double(color.at(c, x, y)) - color.at(c, x + dx, y + dy), 2);
    return std::exp(-squared / (2 * sigma * sigma));
  };
}

// A radius of 5 makes 120 taps: full batches and a remainder.
TEST(Window, BilateralFilter) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {150, 21}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    const auto image = noise_image(width, height, 3, 41);
    Node by_color("color_weight"), node("window");
    by_color.set("sigma", 0.4f).in("image", image);
    node.set("radius", 5).set("sigma", 2.5f).in("image", image).in("weights", by_color);
    const FilterOracle expected{5,
                                1,
                                [](int dx, int dy) { return std::exp(-(dx * dx + dy * dy) / (2 * 2.5 * 2.5)); },
                                {by_color_formula(image, 0.4)}};
    for_each_target([&] {
      EXPECT_LE(
          largest_difference(node.run("image"), [&](int c, int x, int y) { return expected.mean(image, c, x, y); }),
          5e-6);
    });
  }
}

TEST(Window, DiscLeavesTheCornersOut) {
  const auto image = noise_image(60, 40, 2, 45);
  for (const int radius : {1, 2, 7}) {
    Node node("window");
    node.set("radius", radius).set("shape", "disc").set("sigma", 3.0f).in("image", image);
    const FilterOracle expected{radius,
                                1,
                                [=](int dx, int dy) {
                                  const int squared = dx * dx + dy * dy;
                                  return squared <= radius * radius ? std::exp(-squared / (2 * 3.0 * 3.0)) : 0.0;
                                },
                                {}};
    for_each_target([&] {
      EXPECT_LE(
          largest_difference(node.run("image"), [&](int c, int x, int y) { return expected.mean(image, c, x, y); }),
          5e-6);
    });
  }
}

TEST(Window, FlatKernelIsTheMean) {
  const auto image = noise_image(60, 40, 2, 42);
  Node node("window");
  node.set("radius", 32).set("kernel", "flat").in("image", image);
  const FilterOracle expected{32, 1, [](int, int) { return 1.0; }, {}};
  for_each_target([&] {
    // Thousands of terms of a float sum.
    EXPECT_LE(largest_difference(node.run("image"), [&](int c, int x, int y) { return expected.mean(image, c, x, y); }),
              5e-5);
  });
}

// A weight without effect leaves the plain kernel; one that shuts everything out, the image.
TEST(Window, LimitsOfTheBilateralFilter) {
  const auto image = noise_image(60, 20, 3, 43);
  Node wide("color_weight"), narrow("color_weight"), plain("window"), blurred("window"), kept("window");
  wide.set("sigma", 1e9f).in("image", image);
  narrow.set("sigma", 1e-4f).in("image", image);
  const auto expected = plain.in("image", image).run("image");
  const auto out = blurred.in("image", image).in("weights", wide).run("image");
  EXPECT_LE(largest_difference(out, [&](int c, int x, int y) { return double(expected.at(c, x, y)); }), 1e-6);
  const auto same = kept.in("image", image).in("weights", narrow).run("image");
  EXPECT_LE(largest_difference(same, [&](int c, int x, int y) { return double(image.at(c, x, y)); }), 1e-6);
}

TEST(Window, SameBitsForAnyTiles) {
  const auto image = noise_image(333, 40, 3, 44);
  Node by_color("color_weight"), node("window");
  by_color.in("image", image);
  node.set("radius", 9).in("image", image).in("weights", by_color);
  const auto whole = node.run("image");
  for (const auto& [rows, columns] : {std::pair{1, 0}, {7, 50}, {40, 129}})
    EXPECT_TRUE(same_bits(whole, node.tiles(rows, columns).run("image"))) << rows << "x" << columns;
}

}  // namespace
}  // namespace quell::test
