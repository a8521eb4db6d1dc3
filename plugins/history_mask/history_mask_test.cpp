// history_mask against the taps of bilinear positions, one by one.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 37, kHeight = 15;

// Still pixels, whole and fractional steps, and some that lead out.
Image motions() {
  auto motion = noise_image(kWidth, kHeight, 2, 5, -3, 3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 2; ++c) {
        float& m = motion.at(c, x, y);
        if ((x + 2 * y) % 3 == 0) m = std::round(m);
        if ((x + y) % 7 == 0) m = 0;
      }
  return motion;
}
Image objects(int shift) {
  Image id(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) id.bits(0, y)[x] = std::uint32_t((x + shift) / 9 + 10 * (y / 6));
  return id;
}

// Of the four pixels around the previous position, those with weight: how many there are, and how many show the object.
struct Count {
  int all = 0, valid = 0;
};
Count count(const Image& motion, const Image& id, const Image& before, int x, int y) {
  Count n;
  const float px = float(x) + motion.at(0, x, y), py = float(y) + motion.at(1, x, y);
  const int bx = int(std::floor(px)), by = int(std::floor(py));
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double w = (1 - std::abs(double(px) - (bx + i))) * (1 - std::abs(double(py) - (by + j)));
      if (w <= 0) continue;
      ++n.all;
      const int u = bx + i, v = by + j;
      n.valid += u >= 0 && v >= 0 && u < kWidth && v < kHeight && before.bits(0, v)[u] == id.bits(0, y)[x];
    }
  return n;
}

TEST(HistoryMask, KnowsWhereAllTapsAreValid) {
  const auto motion = motions(), id = objects(0), before = objects(2);
  Node surface("disocclusion"), node("history_mask"), fresh("history_mask");
  const auto taps =
      surface.set("fallback", false).in("motion", motion).in("id", id).in("id_before", before).run("taps");
  const auto known = node.in("motion", motion).in("taps", taps).in("before", id).run("mask");
  const auto is_new = fresh.set("where", "new").in("motion", motion).in("taps", taps).run("mask");
  int marked = 0, unknown = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto n = count(motion, id, before, x, y);
      const float px = float(x) + motion.at(0, x, y), py = float(y) + motion.at(1, x, y);
      const bool inside = px >= -0.5f && py >= -0.5f && px < kWidth - 0.5f && py < kHeight - 0.5f;
      EXPECT_EQ(known.at(0, x, y), inside && n.valid == n.all ? 1.0f : 0.0f) << x << "," << y;
      if (n.valid == 0 || !inside) EXPECT_EQ(is_new.at(0, x, y), 1.0f) << x << "," << y;
      if (n.valid == n.all && inside) EXPECT_EQ(is_new.at(0, x, y), 0.0f) << x << "," << y;
      marked += known.at(0, x, y) > 0, unknown += is_new.at(0, x, y) > 0;
    }
  EXPECT_GT(marked, kWidth * kHeight / 5);
  EXPECT_GT(unknown, kWidth * kHeight / 20);
}

TEST(HistoryMask, OfStillPixelsIsWholeUpToTheBorder) {
  const auto still = constant_image(kWidth, kHeight, 2, 0);
  Node surface("disocclusion"), node("history_mask");
  const auto taps = surface.in("motion", still).run("taps");
  const auto mask = node.in("motion", still).in("taps", taps).run("mask");
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) EXPECT_EQ(mask.at(0, x, y), 1.0f);
}

TEST(HistoryMask, IsEmptyWithoutAPast) {
  const auto still = constant_image(kWidth, kHeight, 2, 0), image = constant_image(kWidth, kHeight, 3, 0);
  const auto taps = Node("disocclusion").in("motion", still).run("taps");
  for (const char* where : {"known", "new"}) {
    Node node("history_mask");
    const auto mask =
        node.set("where", where).in("motion", still).in("taps", taps).in_missing("before", image).run("mask");
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) EXPECT_EQ(mask.at(0, x, y), 0.0f) << where;
  }
}

}  // namespace
}  // namespace quell::test
