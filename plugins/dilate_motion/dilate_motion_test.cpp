// The motion that counts, looked for pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;
using quell::test::same_bits;

TEST(DilateMotion, FollowsTheFastestOrTheNearest) {
  for_each_target([&] {
    for (const auto& [width, height, radius] : {std::tuple{1, 1, 1}, {1, 9, 2}, {17, 3, 1}, {45, 20, 3}})
      for (const bool by_depth : {false, true}) {
        auto motion = noise_image(width, height, 2, 1, -5, 5);
        for (int y = 0; y < height; ++y)  // half pixels: lengths are exact, and many are equal
          for (int x = 0; x < width; ++x)
            for (int c = 0; c < 2; ++c) motion.at(c, x, y) = std::round(motion.at(c, x, y)) / 2;
        auto depth = noise_image(width, height, 1, 2, 1, 9);
        for (int x = 0; x < width; x += 3) depth.at(0, x, 0) = 1e30f;
        Node node("dilate_motion");
        node.set("by", by_depth ? "depth" : "length").set("radius", radius).in("motion", motion).in("depth", depth);
        const auto out = node.run("motion");
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            const auto claim = [&](int u, int v) {
              const double mx = motion.at(0, u, v), my = motion.at(1, u, v);
              return by_depth ? -double(depth.at(0, u, v)) : mx * mx + my * my;
            };
            int bu = x, bv = y;
            for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
              for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u)
                if (claim(u, v) > claim(bu, bv)) bu = u, bv = v;
            for (int c = 0; c < 2; ++c) EXPECT_EQ(out.at(c, x, y), motion.at(c, bu, bv)) << x << ',' << y;
          }
      }
  });
}

TEST(DilateMotion, KeepsWhatIsAlikeAndNeedsDepthOnlyByDepth) {
  const auto motion = constant_image(9, 5, 2, 0.3f);
  EXPECT_TRUE(same_bits(Node("dilate_motion").in("motion", motion).run("motion"), motion));
  try {
    Node("dilate_motion").set("by", "depth").in("motion", motion).run("motion");
    FAIL() << "no error";
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(), "by depth needs 'depth', which is not connected; by length does without");
  }
}

}  // namespace
