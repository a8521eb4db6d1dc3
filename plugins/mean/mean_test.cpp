// mean against a sum in one go, and what a trim leaves.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace quell::test {
namespace {

std::vector<double> entering(const Image& map, const Image* mask) {
  std::vector<double> values;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      if (!mask || mask->at(0, x, y) > 0) values.push_back(map.at(0, x, y));
  return values;
}

double average(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / double(values.size());
}

TEST(Mean, IsTheMeanOfThePixelsThatEnter) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {211, 67}}) {
    const auto map = noise_image(width, height, 1, 3, -1, 5), mask = noise_image(width, height, 1, 4, -1, 1);
    Node all("mean"), some("mean");
    const auto whole = all.in("map", map).run(), part = some.in("map", map).in("mask", mask).run();
    const auto expected = entering(map, &mask);
    // Sums in double in another order; the result is rounded to float.
    EXPECT_NEAR(whole[0].at(0, 0, 0), average(entering(map, nullptr)), 4e-7);
    EXPECT_EQ(whole[1].at(0, 0, 0), float(width * height));
    EXPECT_NEAR(part[0].at(0, 0, 0), average(expected), 4e-7);
    EXPECT_EQ(part[1].at(0, 0, 0), float(expected.size()));
  }
}

TEST(Mean, TrimsTheLargest) {
  const auto map = noise_image(50, 40, 1, 8, 0, 10), mask = noise_image(50, 40, 1, 9, -0.5f, 1);
  for (const float trim : {0.0001f, 0.001f, 0.1f, 0.5f}) {
    Node node("mean");
    const auto out = node.set("trim", trim).in("map", map).in("mask", mask).run();
    auto values = entering(map, &mask);
    std::ranges::sort(values);
    values.resize(values.size() - std::size_t(double(trim) * double(values.size())));
    EXPECT_NEAR(out[0].at(0, 0, 0), average(values), 1e-6) << trim;
    EXPECT_EQ(out[1].at(0, 0, 0), float(values.size())) << trim;
  }
}

TEST(Mean, TrimsAsManyOfEqualPixelsAsItShould) {
  auto map = constant_image(10, 10, 1, 2);
  for (int x = 0; x < 5; ++x) map.at(0, x, 0) = 100;
  Node node("mean");
  const auto out = node.set("trim", 0.25f).in("map", map).run();
  EXPECT_EQ(out[0].at(0, 0, 0), 2.0f);
  EXPECT_EQ(out[1].at(0, 0, 0), 75.0f);
}

TEST(Mean, IsNotLostInManyPixels) {
  // In float a sum of this many would stand still at 2^24.
  const auto map = constant_image(4099, 4099, 1, 1.0f);
  EXPECT_EQ(Node("mean").in("map", map).run("value").at(0, 0, 0), 1.0f);
}

TEST(Mean, HidesNoNaN) {
  auto map = constant_image(20, 10, 1, 1);
  map.at(0, 7, 3) = std::numeric_limits<float>::quiet_NaN();
  const auto mean = Node("mean").in("map", map).run("value");
  EXPECT_TRUE(std::isnan(mean.at(0, 0, 0)));
  EXPECT_TRUE(std::isnan(Node("decibel").in("error", mean).run("decibels").at(0, 0, 0)));
  EXPECT_TRUE(std::isnan(Node("power").set("exponent", 0.5f).in("value", mean).run("value").at(0, 0, 0)));
}

TEST(Mean, OfNothingIsZeroFromNoPixels) {
  const auto map = constant_image(4, 4, 1, 7), none = constant_image(4, 4, 1, 0);
  Node node("mean"), trimmed("mean");
  for (const auto& out :
       {node.in("map", map).in("mask", none).run(), trimmed.set("trim", 0.5f).in("map", map).in("mask", none).run()}) {
    EXPECT_EQ(out[0].at(0, 0, 0), 0.0f);
    EXPECT_EQ(out[1].at(0, 0, 0), 0.0f);
  }
}

}  // namespace
}  // namespace quell::test
