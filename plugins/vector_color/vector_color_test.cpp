// vector_color against its formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/run_node.h"

namespace {

using quell::test::Node;
using quell::test::noise_image;

TEST(VectorColor, IsItsFormulas) {
  auto image = noise_image(17, 3, 3, 1, -3.0f, 3.0f);
  for (int c = 0; c < 3; ++c) image.at(c, 4, 1) = 0;
  const auto sign = Node("vector_color").set("unit", 2.0f).in("image", image).run("image");
  const auto repeat = Node("vector_color").set("unit", 2.0f).set("mode", "repeat").in("image", image).run("image");
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 17; ++x)
      for (int c = 0; c < 3; ++c) {
        const double v = image.at(c, x, y) / 2.0;
        const bool nothing = x == 4 && y == 1;
        EXPECT_NEAR(sign.at(c, x, y), nothing ? 0 : std::clamp(0.5 + 0.5 * v, 0.0, 1.0), 1e-7);
        EXPECT_NEAR(repeat.at(c, x, y), nothing ? 0 : v - std::floor(v), 2e-7);
      }
}

TEST(VectorColor, WantsThreeChannels) {
  const auto image = noise_image(3, 3, 2, 1);
  try {
    Node("vector_color").in("image", image).run("image");
    ADD_FAILURE();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "an image of 3 channels is wanted, not of 2");
  }
}

}  // namespace
