// energy_removed against sums in one go, and behind a clamp.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

namespace quell::test {
namespace {

double luminance(const Image& i, int x, int y) {
  return 0.2126 * i.at(0, x, y) + 0.7152 * i.at(1, x, y) + 0.0722 * i.at(2, x, y);
}

TEST(EnergyRemoved, IsTheDifferenceOfMeans) {
  constexpr int kWidth = 67, kHeight = 21;
  const auto before = noise_image(kWidth, kHeight, 3, 77);
  auto after = before.copy();
  int changed = 0;
  for (int y = 0; y < kHeight; y += 2)
    for (int x = 0; x < kWidth; x += 3) after.at(x % 3, x, y) *= 0.25f, ++changed;
  double first = 0, second = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) first += luminance(before, x, y), second += luminance(after, x, y);
  Node node("energy_removed");
  const auto out = node.in("before", before).in("after", after).run();
  EXPECT_NEAR(out[0].at(0, 0, 0), (first - second) / (kWidth * kHeight), 1e-6);
  EXPECT_NEAR(out[1].at(0, 0, 0), (first - second) / first, 1e-6);
  EXPECT_FLOAT_EQ(out[2].at(0, 0, 0), float(changed) / (kWidth * kHeight));
}

TEST(EnergyRemoved, NothingIsTakenFromTheDark) {
  const auto black = constant_image(9, 9, 3, 0.0f);
  Node node("energy_removed");
  for (const auto& value : node.in("before", black).in("after", black).run()) EXPECT_EQ(value.at(0, 0, 0), 0);
}

// One firefly of 1000 among 15 · 15 pixels of 1, all of which a clamp takes.
TEST(EnergyRemoved, SeesAFirefly) {
  auto image = constant_image(15, 15, 3, 1.0f);
  for (int c = 0; c < 3; ++c) image.at(c, 7, 7) = 1001;
  Node clamp("outlier_rank"), node("energy_removed");
  const auto clamped = clamp.in("image", image).run("image");
  const auto out = node.in("before", image).in("after", clamped).run();
  EXPECT_NEAR(out[0].at(0, 0, 0), 1000.0 / 225, 1e-4);
  EXPECT_NEAR(out[1].at(0, 0, 0), 1000.0 / 1225, 1e-6);
  EXPECT_NEAR(out[2].at(0, 0, 0), 1.0 / 225, 1e-8);
}

}  // namespace
}  // namespace quell::test
