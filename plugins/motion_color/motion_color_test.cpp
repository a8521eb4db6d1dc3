// motion_color: directions by their names, lengths by brightness.
#include <gtest/gtest.h>

#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::Node;

struct Rgb {
  float r, g, b;
};

Rgb color_of(float dx, float dy, float longest = 10) {
  Image motion(1, 1, 2);
  motion.at(0, 0, 0) = dx, motion.at(1, 0, 0) = dy;
  const auto out = Node("motion_color").set("longest", longest).in("motion", motion).run("image");
  return {out.at(0, 0, 0), out.at(1, 0, 0), out.at(2, 0, 0)};
}

void expect_color(const Rgb& is, const Rgb& wanted) {
  EXPECT_NEAR(is.r, wanted.r, 1e-6);
  EXPECT_NEAR(is.g, wanted.g, 1e-6);
  EXPECT_NEAR(is.b, wanted.b, 1e-6);
}

TEST(MotionColor, HueIsDirection) {
  expect_color(color_of(10, 0), {1, 0, 0});
  expect_color(color_of(0, 10), {0.5f, 1, 0});  // down: a quarter of the wheel
  expect_color(color_of(-10, 0), {0, 1, 1});
  expect_color(color_of(0, -10), {0.5f, 0, 1});
}

TEST(MotionColor, BrightnessIsLength) {
  expect_color(color_of(0, 0), {0, 0, 0});
  expect_color(color_of(5, 0), {0.5f, 0, 0});
  expect_color(color_of(-2.5f, 0), {0, 0.25f, 0.25f});
  expect_color(color_of(500, 0), {1, 0, 0});
}

TEST(MotionColor, UnknownMotionIsGrey) { expect_color(color_of(1e6f, 1e6f), {0.5f, 0.5f, 0.5f}); }

}  // namespace
