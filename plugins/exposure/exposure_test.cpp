// exposure is a power of two.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

TEST(Exposure, ScalesByStopsAndByTheValue) {
  const auto image = noise_image(67, 3, 3, 1, 0.0f, 10.0f);
  const auto more = constant_image(1, 1, 1, -0.75f);
  for_each_target([&] {
    const auto plain = Node("exposure").set("stops", 1.5f).in("image", image).run("image");
    const auto both = Node("exposure").set("stops", 1.5f).in("image", image).in("more", more).run("image");
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 67; ++x) {
          const double v = image.at(c, x, y);
          // One rounding of the factor and one of the product, half a unit each.
          EXPECT_NEAR(plain.at(c, x, y), v * std::exp2(1.5), 1.3e-7 * v * std::exp2(1.5));
          EXPECT_NEAR(both.at(c, x, y), v * std::exp2(0.75), 1.3e-7 * v * std::exp2(0.75));
        }
  });
}

TEST(Exposure, WholeStopsAreExactAndUndoEachOther) {
  const auto image = noise_image(17, 3, 3, 2, 0.0f, 10.0f);
  const auto up = Node("exposure").set("stops", 3.0f).in("image", image).run("image");
  EXPECT_TRUE(quell::test::same_bits(Node("exposure").set("stops", -3.0f).in("image", up).run("image"), image));
  EXPECT_TRUE(quell::test::same_bits(Node("exposure").in("image", image).run("image"), image));
}

TEST(Exposure, StaysFinite) {
  const auto image = constant_image(5, 1, 3, 1e38f), more = constant_image(1, 1, 1, 1000.0f);
  for_each_target([&] {
    const auto out = Node("exposure").set("stops", 32.0f).in("image", image).in("more", more).run("image");
    EXPECT_EQ(out.at(2, 4, 0), std::numeric_limits<float>::max());
  });
}

}  // namespace
