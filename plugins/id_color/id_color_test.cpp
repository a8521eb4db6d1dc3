// id_color: one object, one colour, and many objects tell themselves apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include <quell/types.h>

#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::Node;

TEST(IdColor, TellsObjectsApart) {
  Image id(64, 32, 1);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) id.bits(0, y)[x] = std::uint32_t(64 * (y % 16) + x);
  const auto out = Node("id_color").in("id", id).run("image");
  std::set<std::array<float, 3>> colors;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::array<float, 3> color{out.at(0, x, y), out.at(1, x, y), out.at(2, x, y)};
      for (int c = 0; c < 3; ++c) EXPECT_EQ(color[std::size_t(c)], out.at(c, x, y % 16));
      EXPECT_GE(*std::ranges::min_element(color), 0.25f);
      EXPECT_LE(*std::ranges::max_element(color), 1.0f);
      colors.insert(color);
    }
  EXPECT_EQ(colors.size(), 1024u);  // of 2^24 colours
}

TEST(IdColor, MissesAreBlack) {
  Image id(1, 1, 1);
  id.bits(0, 0)[0] = quell::kNoId;
  const auto out = Node("id_color").in("id", id).run("image");
  for (int c = 0; c < 3; ++c) EXPECT_EQ(out.at(c, 0, 0), 0.0f);
}

}  // namespace
