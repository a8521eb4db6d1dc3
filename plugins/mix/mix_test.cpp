// Mixing against its formula, and what must stay as it is.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

Image mix(const Image& image, const Image& other, const Image& share) {
  return Node("mix").in("image", image).in("other", other).in("share", share).run("image");
}

TEST(Mix, FollowsItsFormula) {
  for_each_target([&] {
    const auto image = noise_image(17, 3, 3, 1, -10, 10), other = noise_image(17, 3, 3, 2, -10, 10);
    const auto share = noise_image(17, 3, 1, 3, -0.5f, 1.5f);
    const auto out = mix(image, other, share);
    int held = 0;
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 17; ++x) {
          const double s = std::clamp(double(share.at(0, x, y)), 0.0, 1.0);
          held += s == 0 || s == 1;
          // Three roundings of values up to 20.
          EXPECT_NEAR(out.at(c, x, y), (1 - s) * image.at(c, x, y) + s * other.at(c, x, y), 6e-6);
        }
    EXPECT_GT(held, 30) << "shares beyond both ends";
  });
}

TEST(Mix, LeavesTheImageToTheBitWhereItMust) {
  for_each_target([&] {
    const auto image = noise_image(17, 3, 3, 1, 0, 10), far = noise_image(17, 3, 3, 2, 0, 1e6f);
    const auto none = mix(image, far, constant_image(17, 3, 1, 0)), same = mix(image, image, noise_image(17, 3, 1, 4));
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 17; ++x) {
          EXPECT_EQ(none.at(c, x, y), image.at(c, x, y));
          EXPECT_EQ(same.at(c, x, y), image.at(c, x, y));
        }
  });
}

}  // namespace
