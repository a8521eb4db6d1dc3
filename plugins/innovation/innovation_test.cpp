// innovation against a direct search, and what it takes for texture and for noise.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

struct Frames {
  Image now, before, motion;
  Frames(int width, int height, float speed)
      : now(noise_image(width, height, 3, 71)),
        before(noise_image(width, height, 3, 72)),
        motion(noise_image(width, height, 2, 73, -speed, speed)) {
    // A few pixels that nothing foretells, on either side of the tolerance.
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if ((x + 3 * y) % 7 == 0) now.at((x + y) % 3, x, y) = 0.9f + 0.1f * float(x % 5);
  }
  Image taps() const { return Node("disocclusion").in("motion", motion).run("taps"); }

  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < now.width() && y < now.height(); }
  double beyond(const Image& image, double value, int c, int x0, int y0, int side, bool without_centre) const {
    double low = INFINITY, high = -INFINITY;
    for (int y = y0; y < y0 + side; ++y)
      for (int x = x0; x < x0 + side; ++x) {
        if (without_centre && x == x0 + 1 && y == y0 + 1) continue;
        low = std::min<double>(low, image.at(c, x, y)), high = std::max<double>(high, image.at(c, x, y));
      }
    return std::max(low - value, value - high);
  }
  double formula(double tolerance, double share, int x, int y) const {
    if (!inside(x - 1, y - 1) || !inside(x + 1, y + 1)) return 0;
    const int u = int(std::floor(float(x) + motion.at(0, x, y))), v = int(std::floor(float(y) + motion.at(1, x, y)));
    if (!inside(u - 1, v - 1) || !inside(u + 2, v + 2)) return 0;
    double beside = -INFINITY, ago = -INFINITY;
    for (int c = 0; c < 3; ++c) {
      const double value = now.at(c, x, y);
      beside = std::max(beside, beyond(now, value, c, x - 1, y - 1, 3, true));
      ago = std::max(ago, beyond(before, value, c, u - 1, v - 1, 4, false));
    }
    return beside > tolerance && ago > tolerance ? 1 / share : 0;
  }
};

// The comparisons are of the same floats, but for the sums in which a motion meets a whole number.
TEST(Innovation, IsItsFormula) {
  for (const auto& [width, height, speed] : {std::tuple{1, 1, 0.0f}, {1, 9, 1.0f}, {17, 3, 1.0f}, {90, 40, 2.3f}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    const Frames f(width, height, speed);
    const auto taps = f.taps();
    Node node("innovation");
    node.set("tolerance", 0.02f).set("share", 0.25f);
    node.in("image", f.now).in("before", f.before).in("motion", f.motion).in("taps", taps);
    for_each_target([&] {
      const auto out = node.run("innovation");
      EXPECT_EQ(
          largest_difference(out, [&](int, int x, int y) { return f.formula(double(0.02f), double(0.25f), x, y); }), 0);
      int marked = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) marked += out.at(0, x, y) > 0;
      if (width == 90) {
        EXPECT_GT(marked, 50);
      }
    });
  }
}

Image checker(float shift) {
  Image image(64, 32, 3);
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 64; ++x)
        image.at(c, x, y) = (int(std::floor((float(x) + shift) / 3)) + y / 2) % 2 ? 0.8f : 0.1f;
  return image;
}

TEST(Innovation, AMovingTextureIsNone) {
  Image motion(64, 32, 2);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) motion.at(0, x, y) = 1.37f;
  const auto taps = Node("disocclusion").in("motion", motion).run("taps");
  const auto now = checker(1.37f), before = checker(0);
  Node node("innovation");
  const auto out = node.in("image", now).in("before", before).in("motion", motion).in("taps", taps).run("innovation");
  EXPECT_TRUE(same_bits(out, constant_image(64, 32, 1, 0)));
}

TEST(Innovation, NeitherIsASurfaceThatTurnsBrightAsAWhole) {
  const auto motion = constant_image(32, 32, 2, 0), taps = Node("disocclusion").in("motion", motion).run("taps");
  const auto now = constant_image(32, 32, 3, 0.9f), before = constant_image(32, 32, 3, 0.2f);
  Node node("innovation");
  const auto out = node.in("image", now).in("before", before).in("motion", motion).in("taps", taps).run("innovation");
  EXPECT_TRUE(same_bits(out, constant_image(32, 32, 1, 0)));
}

TEST(Innovation, NothingIsNewWithoutAPast) {
  const Frames f(32, 32, 1);
  const auto taps = f.taps();
  Node node("innovation");
  node.in("image", f.now).in_missing("before", f.before).in("motion", f.motion).in("taps", taps);
  EXPECT_TRUE(same_bits(node.run("innovation"), constant_image(32, 32, 1, 0)));
}

TEST(Innovation, SameBitsForAnyTiles) {
  const Frames f(333, 30, 2);
  const auto taps = f.taps();
  Node node("innovation");
  node.set("tolerance", 0.02f).in("image", f.now).in("before", f.before).in("motion", f.motion).in("taps", taps);
  const auto whole = node.run("innovation");
  for (const auto& [rows, columns] : {std::pair{1, 0}, {7, 50}, {40, 129}})
    EXPECT_TRUE(same_bits(whole, node.tiles(rows, columns).run("innovation"))) << rows << "x" << columns;
}

}  // namespace
}  // namespace quell::test
