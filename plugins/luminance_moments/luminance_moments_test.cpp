// Moments against their formula.
#include <gtest/gtest.h>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

TEST(LuminanceMoments, AreLuminanceAndItsSquare) {
  for_each_target([] {
    const auto color = noise_image(37, 3, 3, 1, 0.0f, 30.0f);
    const auto moments = Node("luminance_moments").in("image", color).run("moments");
    ASSERT_EQ(moments.channels(), 2);
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 37; ++x) {
        const double l = 0.2126 * color.at(0, x, y) + 0.7152 * color.at(1, x, y) + 0.0722 * color.at(2, x, y);
        EXPECT_NEAR(moments.at(0, x, y), l, 3e-7 * l);
        EXPECT_NEAR(moments.at(1, x, y), l * l, 6e-7 * l * l);
      }
  });
}

}  // namespace
