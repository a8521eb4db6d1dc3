// atrous against weighted sums in double precision, and the algebra of the B3 cascade.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace quell::test {
namespace {

double b3(int i) { return std::abs(i) == 0 ? 6 / 16.0 : std::abs(i) == 1 ? 4 / 16.0 : 1 / 16.0; }

FilterOracle oracle(int step) {
  return {2, step, [](int dx, int dy) { return b3(dx) * b3(dy); }, {}};
}

struct Guides {
  Image normal, color;
  Node by_normal{"normal_weight"}, by_color{"color_weight"};
  Guides(int width, int height)
      : normal(normal_image(width, height, 21, true)), color(noise_image(width, height, 3, 22)) {
    by_normal.in("normal", normal);
    by_color.in("image", color).set("sigma", 0.5f);
  }
  std::vector<WeightFormula> formulas() const {
    return {[this](int x, int y, int dx, int dy) {
              double dot = 0, here = 0, there = 0;
              for (int c = 0; c < 3; ++c) {
                const double p = normal.at(c, x, y), q = normal.at(c, x + dx, y + dy);
                dot += p * q, here += p * p, there += q * q;
              }
              return here > 0 && there > 0 ? std::pow(std::max(0.0, std::min(1.0, dot)), 128) : double(here == there);
            },
            [this](int x, int y, int dx, int dy) {
              double squared = 0;
              for (int c = 0; c < 3; ++c)
                squared += std::pow(double(color.at(c, x, y)) - color.at(c, x + dx, y + dy), 2);
              return std::exp(-squared / (2 * 0.5 * 0.5));
            }};
  }
};

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{1, 1}, {1, 9}, {17, 3}, {130, 12}, {300, 70}};

TEST(Atrous, PlainKernel) {
  for (const auto [width, height] : kSizes)
    for (const int step : {1, 2, 16, 64}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height << " step " << step);
      const auto image = noise_image(width, height, 3, 23);
      Node node("atrous");
      node.set("step", step).in("image", image);
      const auto expected = oracle(step);
      for_each_target([&] {
        EXPECT_LE(
            largest_difference(node.run("image"), [&](int c, int x, int y) { return expected.mean(image, c, x, y); }),
            1e-6);
      });
    }
}

TEST(Atrous, WeightedImageAndVariance) {
  for (const auto [width, height] : kSizes)
    for (const int step : {1, 4}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height << " step " << step);
      const auto image = noise_image(width, height, 3, 24), variance = noise_image(width, height, 1, 25);
      Guides guides(width, height);
      Node node("atrous");
      node.set("step", step).in("image", image).in("variance", variance);
      node.in("weights", guides.by_normal).in("weights", guides.by_color);
      auto expected = oracle(step);
      expected.weights = guides.formulas();
      for_each_target([&] {
        const auto out = node.run();
        // The weights differ from the formulas by 6e-5 (normal_weight), the mean of values in [0,1] by no more.
        EXPECT_LE(largest_difference(out[0], [&](int c, int x, int y) { return expected.mean(image, c, x, y); }), 6e-5);
        EXPECT_LE(largest_difference(out[1], [&](int, int x, int y) { return expected.variance(variance, x, y); }),
                  6e-5);
      });
    }
}

TEST(Atrous, AnyNumberOfChannels) {
  constexpr int kWidth = 140, kHeight = 11;
  for (const int channels : {1, 2, 4, 9}) {
    const auto image = noise_image(kWidth, kHeight, channels, 26), variance = noise_image(kWidth, kHeight, 1, 27);
    Guides guides(kWidth, kHeight);
    Node node("atrous");
    node.in("image", image).in("variance", variance).in("weights", guides.by_color);
    auto expected = oracle(1);
    expected.weights = {guides.formulas()[1]};
    for_each_target([&] {
      const auto out = node.run();
      ASSERT_EQ(out[0].channels(), channels);
      EXPECT_LE(largest_difference(out[0], [&](int c, int x, int y) { return expected.mean(image, c, x, y); }), 5e-6);
      EXPECT_LE(largest_difference(out[1], [&](int, int x, int y) { return expected.variance(variance, x, y); }), 5e-6);
    });
  }
}

TEST(Atrous, OtherKernels) {
  const auto image = noise_image(50, 20, 3, 28);
  for (const bool box : {true, false}) {
    Node node("atrous");
    node.set("kernel", box ? "box" : "binomial").set("step", 3).in("image", image);
    const auto along = [=](int i) { return box ? 1 / 3.0 : i ? 0.25 : 0.5; };
    const FilterOracle expected{1, 3, [&](int dx, int dy) { return along(dx) * along(dy); }, {}};
    EXPECT_LE(largest_difference(node.run("image"), [&](int c, int x, int y) { return expected.mean(image, c, x, y); }),
              1e-6);
  }
}

TEST(Atrous, SameBitsForAnyTiles) {
  constexpr int kWidth = 333, kHeight = 61;
  const auto image = noise_image(kWidth, kHeight, 3, 29), variance = noise_image(kWidth, kHeight, 1, 30);
  Guides guides(kWidth, kHeight);
  for_each_target([&] {
    for (const int step : {1, 8}) {
      Node node("atrous");
      node.set("step", step).in("image", image).in("variance", variance);
      node.in("weights", guides.by_normal).in("weights", guides.by_color);
      const auto whole = node.run();
      for (const auto& [rows, columns] : {std::pair{1, 0}, {7, 0}, {64, 50}, {5, 17}, {61, 131}}) {
        const auto tiled = node.tiles(rows, columns).run();
        EXPECT_TRUE(same_bits(whole[0], tiled[0])) << rows << "x" << columns;
        EXPECT_TRUE(same_bits(whole[1], tiled[1])) << rows << "x" << columns;
      }
    }
  });
}

// Two levels of the plain kernel along a line: (1, 4, 10, 20, 31, 40, 44, 40, …) / 256.
TEST(Atrous, CascadeOfTwoLevels) {
  constexpr int kSize = 41, kMiddle = 20;
  Image impulse(kSize, kSize, 1);
  for (int y = 0; y < kSize; ++y) impulse.at(0, kMiddle, y) = 256;
  Node first("atrous"), second("atrous");
  const auto level0 = first.in("image", impulse).run("image");
  const auto level1 = second.set("step", 2).in("image", level0).run("image");
  const double half[] = {44, 40, 31, 20, 10, 4, 1, 0};
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(level1.at(0, kMiddle + i, kMiddle), half[i], 1e-4);
    EXPECT_NEAR(level1.at(0, kMiddle - i, kMiddle), half[i], 1e-4);
  }
}

// Variance of white noise after one level of the plain kernel is Σk² = 0.0747681 of what it was.
TEST(Atrous, VarianceGain) {
  const auto image = constant_image(20, 20, 3, 1.0f), variance = constant_image(20, 20, 1, 2.0f);
  Node node("atrous");
  const auto out = node.in("image", image).in("variance", variance).run("variance");
  EXPECT_NEAR(out.at(0, 10, 10), 2 * 0.0747681, 1e-6);
}

TEST(Atrous, ConstantImageIsAFixedPoint) {
  const auto image = constant_image(70, 33, 3, 0.7f);
  Guides guides(70, 33);
  Node node("atrous");
  const auto out = node.set("step", 2).in("image", image).in("weights", guides.by_normal).run("image");
  EXPECT_LE(largest_difference(out, [](int, int, int) { return double(0.7f); }), 5e-7);
}

// What lies beyond the ends of rows may be anything: it must be neither weighed nor averaged.
TEST(Atrous, NothingBeyondTheRowCounts) {
  constexpr int kWidth = 21, kHeight = 9;
  auto image = noise_image(kWidth, kHeight, 3, 31), color = noise_image(kWidth, kHeight, 3, 32);
  Node by_color("color_weight"), node("atrous");
  by_color.in("image", color);
  node.set("step", 4).in("image", image).in("weights", by_color);
  const auto clean = node.run("image");
  for (Image* i : {&image, &color})
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (auto x = std::ptrdiff_t(kWidth); x < i->pitch(); ++x) i->row(c, y)[x] = x % 2 ? std::nanf("") : HUGE_VALF;
  EXPECT_TRUE(same_bits(clean, node.run("image")));
}

}  // namespace
}  // namespace quell::test
