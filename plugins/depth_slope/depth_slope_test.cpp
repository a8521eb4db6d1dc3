// Slopes of planes, edges, creases and misses.
#include <gtest/gtest.h>
#include <quell/types.h>

#include <cmath>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::kFar;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;

TEST(DepthSlope, FollowsAPlaneInPerspective) {
  for_each_target([&] {
    const int width = 31, height = 17;
    Image depth(width, height, 1);
    const auto z = [](double x, double y) { return 1 / (0.2 + 0.002 * x - 0.004 * y); };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) depth.at(0, x, y) = float(z(x, y));
    const auto slope = Node("depth_slope").in("depth", depth).run("slope");
    for (int y = 1; y + 1 < height; ++y)
      for (int x = 1; x + 1 < width; ++x) {
        const double dx = 0.5 * (z(x + 1, y) - z(x - 1, y)), dy = 0.5 * (z(x, y + 1) - z(x, y - 1));
        EXPECT_NEAR(slope.at(0, x, y), dx, 2e-6);  // a few ulp of the depths, 4 to 9
        EXPECT_NEAR(slope.at(1, x, y), dy, 2e-6);
      }
    EXPECT_NEAR(slope.at(0, 0, 4), z(1, 4) - z(0, 4), 2e-6) << "one-sided at the border";
    EXPECT_NEAR(slope.at(1, 3, height - 1), z(3, height - 1) - z(3, height - 2), 2e-6);
  });
}

TEST(DepthSlope, StaysOnItsOwnSurface) {
  for_each_target([&] {
    //                  near surface   edge   far surface    miss  lone
    const float row[] = {1.0f, 1.1f, 1.2f, 5.0f, 5.05f, 5.1f, kFar, 2.0f, kFar};
    const double expected[] = {0.1, 0.1, 0.1, 0.05, 0.05, 0.05, 0, 0, 0};
    Image depth(9, 1, 1);
    for (int x = 0; x < 9; ++x) depth.at(0, x, 0) = row[x];
    const auto slope = Node("depth_slope").in("depth", depth).run("slope");
    for (int x = 0; x < 9; ++x) {
      EXPECT_NEAR(slope.at(0, x, 0), expected[x], 1e-6) << x;
      EXPECT_EQ(slope.at(1, x, 0), 0) << x;
    }
  });
}

TEST(DepthSlope, TakesTheFlatterSideOfACrease) {
  for_each_target([&] {
    const float row[] = {1.0f, 1.1f, 1.2f, 1.5f, 1.8f, 1.4f, 1.0f};
    const double expected[] = {0.1, 0.1, 0.1, 0.3, 0.3, -0.4, -0.4};
    Image across(7, 1, 1), down(1, 7, 1);
    for (int i = 0; i < 7; ++i) across.at(0, i, 0) = down.at(0, 0, i) = row[i];
    const auto x_slope = Node("depth_slope").in("depth", across).run("slope");
    const auto y_slope = Node("depth_slope").in("depth", down).run("slope");
    for (int i = 0; i < 7; ++i) {
      EXPECT_NEAR(x_slope.at(0, i, 0), expected[i], 1e-6) << i;
      EXPECT_NEAR(y_slope.at(1, 0, i), expected[i], 1e-6) << i;
    }
  });
}

TEST(DepthSlope, OfSkyIsZero) {
  for_each_target([&] {
    const auto sky = constant_image(5, 5, 1, kFar);
    const auto slope = Node("depth_slope").in("depth", sky).run("slope");
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x) EXPECT_EQ(slope.at(0, x, y), 0) << x << ',' << y;
  });
}

}  // namespace
