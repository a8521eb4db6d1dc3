// Counting frames along motion.
#include <gtest/gtest.h>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

Image taps_for(const Image& motion) { return Node("disocclusion").in("motion", motion).run("taps"); }

TEST(HistoryLength, CountsUpToItsMaximum) {
  for_each_target([&] {
    const auto motion = constant_image(9, 3, 2, 0), taps = taps_for(motion);
    auto count = constant_image(9, 3, 1, 0);
    for (int n = 1; n < 12; ++n) {
      auto node = Node("history_length").set("max", 8).in("motion", motion).in("taps", taps);
      count = (n == 1 ? node.in_missing("before", count) : node.in("before", count)).run("count");
      for (int x = 0; x < 9; ++x) EXPECT_EQ(count.at(0, x, 1), float(std::min(n, 8)));
    }
  });
}

TEST(HistoryLength, StartsAnewWhereDisoccluded) {
  for_each_target([&] {
    auto motion = constant_image(9, 3, 2, 0);
    motion.at(0, 4, 1) = -100;
    const auto before = constant_image(9, 3, 1, 5);
    const auto count =
        Node("history_length").in("before", before).in("motion", motion).in("taps", taps_for(motion)).run("count");
    EXPECT_EQ(count.at(0, 4, 1), 1);
    EXPECT_EQ(count.at(0, 5, 1), 6);
  });
}

TEST(HistoryLength, AveragesAsReprojectDoes) {
  for_each_target([&] {
    const auto motion = noise_image(23, 11, 2, 1, -2, 2), before = noise_image(23, 11, 1, 2, 1, 30);
    const auto taps = taps_for(motion);
    const auto count = Node("history_length").in("before", before).in("motion", motion).in("taps", taps).run("count");
    const auto history = Node("reproject").in("image", before).in("motion", motion).in("taps", taps).run("image");
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 23; ++x) EXPECT_NEAR(count.at(0, x, y), std::min(history.at(0, x, y) + 1, 32.0f), 2e-5);
  });
}

TEST(HistoryLength, OfEqualCountsIsWhole) {
  for_each_target([&] {
    const auto motion = noise_image(23, 11, 2, 1, -2, 2), before = constant_image(23, 11, 1, 3);
    const auto count =
        Node("history_length").in("before", before).in("motion", motion).in("taps", taps_for(motion)).run("count");
    int valid = 0;
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 23; ++x) {
        EXPECT_TRUE(count.at(0, x, y) == 4 || count.at(0, x, y) == 1);
        valid += count.at(0, x, y) == 4;
      }
    EXPECT_GT(valid, 150);
  });
}

}  // namespace
