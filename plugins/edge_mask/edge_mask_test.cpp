// edge_mask against pairs of pixels, and against edges that one can count.
#include "tests/support/run_node.h"

#include <quell/types.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quell::test {
namespace {

constexpr int kWidth = 33, kHeight = 14;

int marked(const Image& mask) {
  int count = 0;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) count += mask.at(0, x, y) > 0;
  return count;
}

// Two objects, left of column 10 and right of it.
Image halves() {
  Image id(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) id.bits(0, y)[x] = x < 10 ? 3 : quell::kNoId;
  return id;
}

TEST(EdgeMask, IsAsWideAsItsRadius) {
  const auto id = halves();
  for (const int radius : {1, 2, 5}) {
    const auto mask = Node("edge_mask").set("radius", radius).in("id", id).run("mask");
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        EXPECT_EQ(mask.at(0, x, y), x >= 10 - radius && x < 10 + radius ? 1.0f : 0.0f) << radius << " " << x;
  }
}

TEST(EdgeMask, FindsNormalsAndDepthsThatDiffer) {
  const auto normal = normal_image(kWidth, kHeight, 4, true);
  auto depth = noise_image(kWidth, kHeight, 1, 5, 5, 5.6f);
  depth.at(0, 3, 3) = quell::kFar;
  Node by_normal("edge_mask"), by_depth("edge_mask"), by_both("edge_mask");
  const auto a = by_normal.set("normal_cosine", 0.99f).in("normal", normal).run("mask");
  const auto b = by_depth.in("depth", depth).run("mask");
  const auto both = by_both.set("normal_cosine", 0.99f).in("normal", normal).in("depth", depth).run("mask");
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      bool bend = false, jump = false;
      for (int v = std::max(0, y - 1); v <= std::min(kHeight - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(kWidth - 1, x + 1); ++u) {
          double cosine = 0, here = 0, there = 0;
          for (int c = 0; c < 3; ++c) {
            cosine += double(normal.at(c, x, y)) * normal.at(c, u, v);
            here += std::abs(normal.at(c, x, y)), there += std::abs(normal.at(c, u, v));
          }
          bend |= (here == 0) != (there == 0) || (here > 0 && cosine < double(0.99f));
          const double p = depth.at(0, x, y), q = depth.at(0, u, v);
          jump |= std::abs(p - q) > double(0.1f) * std::min(p, q);
        }
      EXPECT_EQ(a.at(0, x, y), bend ? 1.0f : 0.0f);
      EXPECT_EQ(b.at(0, x, y), jump ? 1.0f : 0.0f);
      EXPECT_EQ(both.at(0, x, y), bend || jump ? 1.0f : 0.0f);
    }
  EXPECT_GT(marked(b), 8) << "the miss and all around it, and more";
  EXPECT_LT(marked(b), kWidth * kHeight);
}

TEST(EdgeMask, MissesAreOneSurface) {
  const auto normal = constant_image(kWidth, kHeight, 3, 0), depth = constant_image(kWidth, kHeight, 1, quell::kFar);
  Node node("edge_mask");
  EXPECT_EQ(marked(node.in("normal", normal).in("depth", depth).run("mask")), 0);
}

TEST(EdgeMask, WantsAGuide) {
  Node node("edge_mask");
  EXPECT_THROW(node.run(), std::runtime_error);
}

}  // namespace
}  // namespace quell::test
