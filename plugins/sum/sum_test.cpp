// Sums in the order of the list.
#include <gtest/gtest.h>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;
using quell::test::same_bits;

TEST(Sum, AddsInOrder) {
  for_each_target([&] {
    const auto a = noise_image(37, 5, 3, 1), b = noise_image(37, 5, 3, 2, 0, 1e4f), c = noise_image(37, 5, 3, 3);
    const auto out = Node("sum").in("images", a).in("images", b).in("images", c).run("image");
    for (int k = 0; k < 3; ++k)
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 37; ++x) EXPECT_EQ(out.at(k, x, y), (a.at(k, x, y) + b.at(k, x, y)) + c.at(k, x, y));
  });
}

TEST(Sum, OfOneIsThatOne) {
  const auto a = noise_image(17, 3, 2, 1);
  EXPECT_TRUE(same_bits(Node("sum").in("images", a).run("image"), a));
}

}  // namespace
