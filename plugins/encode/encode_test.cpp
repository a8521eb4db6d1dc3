// encode against its curves in double, and published points of the PU curve.
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

double pu(double y) {
  y = std::clamp(y, 0.0, 65504.0);
  const double norm = 0.318967155;
  if (y <= 1.57945760e-06) return norm * 1412.83765 * y;
  if (y <= 0.0322087631) return norm * (1.64593172 * std::pow(y, 0.431384981) - 0.00294139609);
  return norm * (0.192653254 * std::log(y + 0.00626026094) + 0.998620152);
}

// Black, each part of the curves and beyond their end, in steps of a quarter stop.
Image radiances() {
  Image image(131, 2, 3);
  for (int x = 0; x < 131; ++x)
    for (int y = 0; y < 2; ++y)
      for (int c = 0; c < 3; ++c)
        image.at(c, x, y) = x == 0 ? 0.0f : x == 130 ? 3e38f : std::exp2(0.25f * float(x + c + y) - 24);
  return image;
}

TEST(Encode, IsItsCurves) {
  const auto image = radiances();
  for_each_target([&] {
    const auto shown = Node("encode").in("image", image).run("image");
    const auto uniform = Node("encode").set("curve", "pu").in("image", image).run("image");
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 131; ++x) {
          const double v = image.at(c, x, y);
          ASSERT_NEAR(shown.at(c, x, y), v / (1 + v), 2e-7 * v / (1 + v)) << v;
          // exp2 to 5e-7 and log2 to 3e-7 of at most 20.
          ASSERT_NEAR(uniform.at(c, x, y), pu(v), 4e-6 * pu(v)) << v;
        }
  });
}

TEST(Encode, AgreesWithPublishedPointsOfPu) {
  const float points[][2] = {{0, 0},          {1e-6f, 0.000450649f}, {0.01f, 0.0710710f}, {0.18f, 0.2152534f},
                             {1, 0.3189105f}, {10, 0.4600595f},      {100, 0.6015189f},   {65504, 1}};
  Image image(8, 1, 3);
  for (int x = 0; x < 8; ++x)
    for (int c = 0; c < 3; ++c) image.at(c, x, 0) = points[x][0];
  for_each_target([&] {
    const auto out = Node("encode").set("curve", "pu").in("image", image).run("image");
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(out.at(0, x, 0), points[x][1], 2e-6 * points[x][1]) << points[x][0];
  });
}

TEST(Encode, RisesFromBlackAndStaysInRange) {
  const auto image = radiances();
  for_each_target([&] {
    for (const char* curve : {"compress", "pu"}) {
      const auto out = Node("encode").set("curve", curve).in("image", image).run("image");
      EXPECT_EQ(out.at(0, 0, 0), 0.0f);
      for (int x = 1; x < 131; ++x) {
        EXPECT_GE(out.at(0, x, 0), out.at(0, x - 1, 0)) << curve << " " << image.at(0, x, 0);
        EXPECT_LE(out.at(0, x, 0), 1.0f + 1e-6f) << curve;
      }
    }
  });
}

}  // namespace
}  // namespace quell::test
