// statistics against sums in one go.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quell::test {
namespace {

TEST(Statistics, AreTheirFormulas) {
  auto image = noise_image(67, 21, 4, 92, -2, 5);
  image.at(1, 3, 3) = std::nanf(""), image.at(3, 66, 20) = std::numeric_limits<float>::infinity();
  double sum = 0, squares = 0, least = 1e9, most = -1e9;
  const double count = 67 * 21 * 4 - 2;
  const auto each = [&](auto visit) {
    for (int c = 0; c < 4; ++c)
      for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 67; ++x)
          if (std::isfinite(image.at(c, x, y))) visit(double(image.at(c, x, y)));
  };
  each([&](double v) { sum += v, least = std::min(least, v), most = std::max(most, v); });
  each([&](double v) { squares += (v - sum / count) * (v - sum / count); });
  Node node("statistics");
  const auto out = node.in("image", image).run();
  EXPECT_NEAR(out[0].at(0, 0, 0), sum / count, 1e-6);
  EXPECT_EQ(out[1].at(0, 0, 0), float(least));
  EXPECT_EQ(out[2].at(0, 0, 0), float(most));
  EXPECT_NEAR(out[3].at(0, 0, 0), std::sqrt(squares / count), 1e-6);
  EXPECT_EQ(out[4].at(0, 0, 0), 2);
}

TEST(Statistics, OfNothingAreZero) {
  const auto image = constant_image(3, 2, 1, std::nanf(""));
  Node node("statistics");
  const auto out = node.in("image", image).run();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(out[std::size_t(i)].at(0, 0, 0), 0);
  EXPECT_EQ(out[4].at(0, 0, 0), 6);
}

}  // namespace
}  // namespace quell::test
