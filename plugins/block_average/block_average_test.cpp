// block_average against sums written out, and its blocks against the image that they cut.
#include <gtest/gtest.h>

#include <cmath>

#include <quell/types.h>

#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::Node;
using quell::test::noise_image;

TEST(BlockAverage, AveragesLuminance) {
  const auto image = noise_image(37, 20, 3, 1, 0.0f, 5.0f);
  const auto blocks = Node("block_average").set("size", 8).in("image", image).run("blocks");
  ASSERT_EQ(blocks.width(), 5);
  ASSERT_EQ(blocks.height(), 3);
  for (int by = 0; by < 3; ++by)
    for (int bx = 0; bx < 5; ++bx) {
      double sum = 0;
      int count = 0;
      for (int y = by * 20 / 3; y < (by + 1) * 20 / 3; ++y)
        for (int x = bx * 37 / 5; x < (bx + 1) * 37 / 5; ++x, ++count)
          sum += 0.2126 * image.at(0, x, y) + 0.7152 * image.at(1, x, y) + 0.0722 * image.at(2, x, y);
      EXPECT_NEAR(blocks.at(0, bx, by), sum / count, 1e-7 * sum / count);  // one rounding to float
    }
}

TEST(BlockAverage, LeavesMissesOut) {
  Image depth = constant_image(16, 32, 1, 3.0f);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) depth.at(0, x, y) = x % 2 ? quell::kFar : 7.0f;
  for (int y = 16; y < 32; ++y)
    for (int x = 0; x < 16; ++x) depth.at(0, x, y) = quell::kFar;
  const auto blocks = Node("block_average").in("image", depth).run("blocks");
  EXPECT_EQ(blocks.at(0, 0, 0), 7.0f);
  EXPECT_EQ(blocks.at(0, 0, 1), 0.0f);
}

TEST(BlockAverage, TakesTheFirstOfOtherChannels) {
  const auto image = noise_image(9, 5, 2, 3);
  const auto blocks = Node("block_average").set("size", 1).in("image", image).run("blocks");
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 9; ++x) EXPECT_EQ(blocks.at(0, x, y), image.at(0, x, y));
}

}  // namespace
