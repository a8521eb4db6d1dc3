// motion_color against its formula, and directions by their names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

TEST(MotionColor, IsItsFormula) {
  const auto motion = noise_image(67, 3, 2, 1, -9.0f, 9.0f);
  for_each_target([&] {
    const auto out = Node("motion_color").set("longest", 8.0f).in("motion", motion).run("image");
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 67; ++x) {
        const double u = motion.at(0, x, y), v = motion.at(1, x, y);
        for (int c = 0; c < 3; ++c) {
          const double hue = 0.5 + std::cos(std::atan2(v, u) - c * 2 * std::numbers::pi / 3);
          const double expected = std::clamp(hue, 0.0, 1.0) * std::min(std::hypot(u, v) / 8, 1.0);
          EXPECT_NEAR(out.at(c, x, y), expected, 5e-7);  // some roundings of 6e-8 of numbers up to 1.5
        }
      }
  });
}

struct Rgb {
  float r, g, b;
};

void expect_color(float dx, float dy, const Rgb& wanted) {
  for_each_target([&] {
    Image motion(1, 1, 2);
    motion.at(0, 0, 0) = dx, motion.at(1, 0, 0) = dy;
    const auto out = Node("motion_color").set("longest", 10.0f).in("motion", motion).run("image");
    EXPECT_NEAR(out.at(0, 0, 0), wanted.r, 1e-6);
    EXPECT_NEAR(out.at(1, 0, 0), wanted.g, 1e-6);
    EXPECT_NEAR(out.at(2, 0, 0), wanted.b, 1e-6);
  });
}

TEST(MotionColor, HueIsDirection) {
  expect_color(10, 0, {1, 0, 0});
  expect_color(0, 10, {0.5f, 1, 0});
  expect_color(-10, 0, {0, 1, 1});
  expect_color(0, -10, {0.5f, 0, 1});
}

TEST(MotionColor, BrightnessIsLength) {
  expect_color(0, 0, {0, 0, 0});
  expect_color(5, 0, {0.5f, 0, 0});
  expect_color(-2.5f, 0, {0, 0.25f, 0.25f});
  expect_color(500, 0, {1, 0, 0});
}

TEST(MotionColor, UnknownMotionIsGrey) { expect_color(1e6f, 1e6f, {0.5f, 0.5f, 0.5f}); }

}  // namespace
