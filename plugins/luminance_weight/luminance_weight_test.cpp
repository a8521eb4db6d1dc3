// luminance_weight against its formula in double precision.
#include "tests/support/falloffs.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 150, kHeight = 19;

double luminance(const Image& i, int x, int y) {
  return 0.2126 * i.at(0, x, y) + 0.7152 * i.at(1, x, y) + 0.0722 * i.at(2, x, y);
}

// Luminances near 1 are held to 1e-7, over a divisor of at least 1e-2.
constexpr double kTolerance = 5e-5;

TEST(LuminanceWeight, InDeviations) {
  const auto image = noise_image(kWidth, kHeight, 3, 7);
  // Rounding can leave a variance below zero, which is none.
  const auto variance = noise_image(kWidth, kHeight, 1, 8, -0.01f, 0.2f);
  Node node("luminance_weight");
  node.set("sigma", 4.0f).set("epsilon", 0.01f).in("image", image).in("variance", variance);
  check_weight(
      node, kWidth, kHeight,
      [&](int x, int y, int dx, int dy) {
        const double deviation = std::sqrt(std::max(0.0, double(variance.at(0, x, y))));
        return std::exp(-std::abs(luminance(image, x, y) - luminance(image, x + dx, y + dy)) / (4 * deviation + 0.01));
      },
      kTolerance);
}

TEST(LuminanceWeight, InRadiance) {
  const auto image = noise_image(kWidth, kHeight, 3, 9);
  Node node("luminance_weight");
  node.set("sigma", 0.25f).in("image", image);
  check_weight(
      node, kWidth, kHeight,
      [&](int x, int y, int dx, int dy) {
        return std::exp(-std::abs(luminance(image, x, y) - luminance(image, x + dx, y + dy)) / 0.25);
      },
      kTolerance);
}

TEST(LuminanceWeight, EveryFalloff) {
  const auto image = noise_image(kWidth, kHeight, 3, 10);
  const auto variance = noise_image(kWidth, kHeight, 1, 11, -0.01f, 0.2f);
  for (const auto& name : falloff_names())
    for (const bool guided : {true, false}) {
      SCOPED_TRACE(testing::Message() << name << " " << guided);
      Node node("luminance_weight");
      node.set("sigma", 0.9f).set("epsilon", 0.01f).set("falloff", name).in("image", image);
      if (guided) node.in("variance", variance);
      check_weight(
          node, kWidth, kHeight,
          [&](int x, int y, int dx, int dy) {
            const double deviation = std::sqrt(std::max(0.0, double(variance.at(0, x, y))));
            const double difference = std::abs(luminance(image, x, y) - luminance(image, x + dx, y + dy));
            return falloff(name, difference / (guided ? 0.9 * deviation + 0.01 : 0.9));
          },
          kTolerance);
    }
}

// With no variance at all and a bright image, equal pixels must still weigh 1.
TEST(LuminanceWeight, EqualPixelsWeighOne) {
  const auto image = constant_image(kWidth, kHeight, 3, 12345.678f),
             variance = constant_image(kWidth, kHeight, 1, 0.0f);
  Node node("luminance_weight");
  node.set("epsilon", 1e-10f).in("image", image).in("variance", variance);
  check_weight(
      node, kWidth, kHeight, [](int, int, int, int) { return 1.0; }, 0);
}

}  // namespace
}  // namespace quell::test
