// depth_weight against its formula in double precision.
#include "tests/support/falloffs.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 150, kHeight = 19;

Image depths() {
  auto depth = noise_image(kWidth, kHeight, 1, 5, 4.0f, 4.5f);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (x > 60) depth.at(0, x, y) += 10;
      if ((x * 7 + y * 13) % 17 == 0) depth.at(0, x, y) = kFar;
    }
  return depth;
}

// Differences of floats near 15 are held to 1e-6, over a divisor of at least 0.01.
constexpr double kTolerance = 1e-4;

TEST(DepthWeight, AlongASlope) {
  const auto depth = depths(), slope = noise_image(kWidth, kHeight, 2, 6, -0.2f, 0.2f);
  for (const bool relative : {false, true}) {
    Node node("depth_weight");
    node.set("sigma", 1.5f).set("epsilon", 0.01f).set("relative", relative).in("depth", depth).in("slope", slope);
    check_weight(
        node, kWidth, kHeight,
        [&](int x, int y, int dx, int dy) {
          const double z = depth.at(0, x, y), least = 0.01 * (relative && z < kFar ? z : 1.0);
          const double change = std::abs(double(slope.at(0, x, y)) * dx + double(slope.at(1, x, y)) * dy);
          return std::exp(-std::abs(z - depth.at(0, x + dx, y + dy)) / (1.5 * change + least));
        },
        kTolerance);
  }
}

TEST(DepthWeight, WithoutASlope) {
  const auto depth = depths();
  for (const bool relative : {false, true}) {
    Node node("depth_weight");
    node.set("sigma", 0.3f).set("relative", relative).in("depth", depth);
    check_weight(
        node, kWidth, kHeight,
        [&](int x, int y, int dx, int dy) {
          const double z = depth.at(0, x, y), scale = relative && z < kFar ? z : 1.0;
          return std::exp(-std::abs(z - depth.at(0, x + dx, y + dy)) / (0.3 * scale));
        },
        kTolerance);
  }
}

TEST(DepthWeight, EveryFalloff) {
  const auto depth = depths(), slope = noise_image(kWidth, kHeight, 2, 6, -0.2f, 0.2f);
  for (const auto& name : falloff_names())
    for (const bool sloped : {false, true}) {
      SCOPED_TRACE(testing::Message() << name << " " << sloped);
      Node node("depth_weight");
      node.set("sigma", 0.8f).set("epsilon", 0.01f).set("falloff", name).in("depth", depth);
      if (sloped) node.in("slope", slope);
      check_weight(
          node, kWidth, kHeight,
          [&](int x, int y, int dx, int dy) {
            const double change = std::abs(double(slope.at(0, x, y)) * dx + double(slope.at(1, x, y)) * dy);
            return falloff(name, std::abs(double(depth.at(0, x, y)) - depth.at(0, x + dx, y + dy)) /
                                     (sloped ? 0.8 * change + 0.01 : 0.8));
          },
          3 * kTolerance);  // the rational falls three times as fast
    }
}

// No parameters let a filter mix what was hit with what was not.
TEST(DepthWeight, MissesAreApartAtAnySetting) {
  auto depth = constant_image(kWidth, kHeight, 1, 1000.0f);
  auto slope = constant_image(kWidth, kHeight, 2, 5.0f);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; x += 3) depth.at(0, x, y) = kFar, slope.at(0, x, y) = slope.at(1, x, y) = 0;
  const auto apart = [&](int x, int y, int dx, int dy) {
    return depth.at(0, x, y) == depth.at(0, x + dx, y + dy) ? 1.0 : 0.0;
  };
  for (const char* name : {"exponential", "rational"})  // the longest tails
    for (const bool relative : {false, true})
      for (const float sigma : {1e-4f, 1.0f, 1e6f})
        for (const float epsilon : {1e-8f, 1.0f}) {
          SCOPED_TRACE(testing::Message() << name << " " << relative << " " << sigma << " " << epsilon);
          Node sloped("depth_weight"), plain("depth_weight");
          for (Node* node : {&sloped, &plain})
            node->set("falloff", name)
                .set("relative", relative)
                .set("sigma", sigma)
                .set("epsilon", epsilon)
                .in("depth", depth);
          check_weight(sloped.in("slope", slope), kWidth, kHeight, apart, 0);
          check_weight(plain, kWidth, kHeight, apart, 0);
        }
}

}  // namespace
}  // namespace quell::test
