// Counting pixels without history.
#include <gtest/gtest.h>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;

TEST(DisoccludedShare, CountsEmptyMasks) {
  for_each_target([&] {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {101, 19}}) {
      Image taps(width, height, 5);
      taps.fill(0);
      int empty = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          // Bit 9 alone, that the 4×4 is whole, says nothing of the 3×3 and never stands alone.
          const std::uint32_t mask[] = {0, 0x1FF, 1, 0x3FF, 0, 0x100, 0};
          taps.bits(4, y)[x] = mask[(3 * x + 5 * y) % 7];
          empty += mask[(3 * x + 5 * y) % 7] == 0;
        }
      const auto share = Node("disoccluded_share").in("taps", taps).run("share");
      EXPECT_EQ(share.at(0, 0, 0), float(double(empty) / (width * height)));
    }
  });
}

TEST(DisoccludedShare, IsWhatDisocclusionFoundToBeNew) {
  const int width = 40, height = 10;
  auto motion = constant_image(width, height, 2, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width / 4; ++x) motion.at(0, x, y) = -100;
  const auto taps = Node("disocclusion").in("motion", motion).run("taps");
  EXPECT_EQ(Node("disoccluded_share").in("taps", taps).run("share").at(0, 0, 0), 0.25f);

  const auto id = constant_image(width, height, 1, 0);
  const auto first = Node("disocclusion").in("motion", motion).in("id", id).in_missing("id_before", id).run("taps");
  EXPECT_EQ(Node("disoccluded_share").in("taps", first).run("share").at(0, 0, 0), 1.0f);
}

}  // namespace
