// in_range against comparisons in double.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

double number(const Image& i, int x, int y) {
  const double a = i.at(0, x, y);
  if (i.channels() == 2) return std::sqrt(a * a + double(i.at(1, x, y)) * i.at(1, x, y));
  if (i.channels() == 3) return 0.2126 * a + 0.7152 * i.at(1, x, y) + 0.0722 * i.at(2, x, y);
  return a;
}

TEST(InRange, MarksWhatLiesInBothRanges) {
  const auto from = constant_image(1, 1, 1, 0.4f), to = constant_image(1, 1, 1, 0.8f);
  for (const int channels : {1, 2, 3, 5})
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 3}, {40, 23}}) {
      const auto image = noise_image(width, height, channels, 6);
      Node plain("in_range"), found("in_range");
      const auto one = plain.set("low", 0.3f).set("high", 0.7f).in("image", image).run("mask");
      const auto two =
          found.set("low", 0.3f).set("high", 0.7f).in("image", image).in("from", from).in("to", to).run("mask");
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double v = number(image, x, y);
          // Where the number is an end but for rounding, either is right.
          if (std::abs(v - 0.3) < 1e-6 || std::abs(v - 0.4) < 1e-6 || std::abs(v - 0.7) < 1e-6) continue;
          ASSERT_EQ(one.at(0, x, y), v > 0.3 && v < 0.7 ? 1.0f : 0.0f) << v;
          ASSERT_EQ(two.at(0, x, y), v > 0.4 && v < 0.7 ? 1.0f : 0.0f) << v;
        }
    }
}

TEST(InRange, HoldsThePercentileThatItIsGiven) {
  const auto image = noise_image(64, 25, 3, 8);
  const auto limit = Node("percentile").set("share", 0.25f).in("image", image).run("value");
  const auto mask = Node("in_range").in("image", image).in("to", limit).run("mask");
  double marked = 0;
  for (int y = 0; y < 25; ++y)
    for (int x = 0; x < 64; ++x) marked += mask.at(0, x, y);
  EXPECT_EQ(marked, 64 * 25 / 4 + 1) << "the number at a quarter, counted from 0, and those below it";
}

TEST(InRange, MarksAllWithoutEnds) {
  const auto image = noise_image(9, 4, 1, 2, -5, 5);
  const auto mask = Node("in_range").in("image", image).run("mask");
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 9; ++x) EXPECT_EQ(mask.at(0, x, y), 1.0f);
}

}  // namespace
}  // namespace quell::test
