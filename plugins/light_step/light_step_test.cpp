// light_step against its formula in double over whole windows.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace quell::test {
namespace {

TEST(LightStep, IsAChangeOfMeans) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {41, 23}})
    for (const int radius : {0, 1, 3}) {
      const auto now = noise_image(width, height, 1, 1, 0, 2), then = noise_image(width, height, 1, 2, 0, 2),
                 mask = noise_image(width, height, 1, 3, -0.2f, 1);
      Node node("light_step");
      node.set("radius", radius).set("threshold", 0.125f).set("floor", 0.0625f);
      const auto out = node.in("image", now).in("before", then).in("mask", mask).tiles(5, 16).run();
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          double n = 0, p = 0, q = 0;
          for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
            for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u)
              if (mask.at(0, u, v) > 0) ++n, p += now.at(0, u, v), q += then.at(0, u, v);
          p /= n, q /= n;
          const bool steps = mask.at(0, x, y) > 0 && std::abs(p - q) > std::max(0.0625, 0.125 * std::max(p, q));
          // Sums of doubles in another order.
          ASSERT_NEAR(out[0].at(0, x, y), steps ? p - q : 0, 1e-6) << x << "," << y << " radius " << radius;
          ASSERT_EQ(out[1].at(0, x, y), !steps ? 0.0f : p > q ? 1.0f : -1.0f) << x << "," << y;
        }
    }
}

// Stripes of one pixel that motion has resampled change everywhere by as much as they hold, and light has not changed.
TEST(LightStep, DoesNotMindTextures) {
  Image sharp(40, 40, 1), shifted(40, 40, 1);
  const auto known = constant_image(40, 40, 1, 1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) sharp.at(0, x, y) = x % 2 ? 1 : 0.2f, shifted.at(0, x, y) = x % 2 ? 0.2f : 1;
  const auto steps = [&](const Image& then, int radius) {
    double count = 0;
    const auto direction = Node("light_step")
                               .set("radius", radius)
                               .in("image", sharp)
                               .in("before", then)
                               .in("mask", known)
                               .run("direction");
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) count += std::abs(direction.at(0, x, y));
    return count;
  };
  EXPECT_EQ(steps(shifted, 3), 0);
  EXPECT_EQ(steps(shifted, 0), 1600);
  auto dim = shifted.copy();
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) dim.at(0, x, y) /= 2;
  EXPECT_EQ(steps(dim, 3), 1600);
}

}  // namespace
}  // namespace quell::test
