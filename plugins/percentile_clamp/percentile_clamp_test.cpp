// percentile_clamp against sorting each cluster.
#include "tests/support/failure.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace quell::test {
namespace {

struct Case {
  int width, height, size;
  float low, high, k;
};

double luminance(const Image& i, int x, int y) {
  return 0.2126 * i.at(0, x, y) + 0.7152 * i.at(1, x, y) + 0.0722 * i.at(2, x, y);
}

double cap(const Image& image, const Case& c, int x, int y) {
  std::vector<double> list;
  for (int v = 0; v < c.height; ++v)
    for (int u = 0; u < c.width; ++u)
      if (u / c.size == x / c.size && v / c.size == y / c.size) list.push_back(luminance(image, u, v));
  std::ranges::sort(list);
  const auto at = [&](float share) { return list[std::size_t(double(share) * double(list.size() - 1))]; };
  return at(c.high) + double(c.k) * (at(c.high) - at(c.low));
}

class PercentileClamp : public testing::TestWithParam<Case> {};

TEST_P(PercentileClamp, IsItsFormula) {
  const auto c = GetParam();
  auto image = noise_image(c.width, c.height, 3, 75);
  for (int y = 0; y < c.height; y += 4)
    for (int x = y % 3; x < c.width; x += 7) image.at(1, x, y) = 300;
  Node node("percentile_clamp");
  node.set("size", c.size).set("low", c.low).set("high", c.high).set("k", c.k).in("image", image);
  const auto out = node.run("image");
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const double l = luminance(image, x, y), most = cap(image, c, x, y);
      for (int k = 0; k < 3; ++k) {
        const double expected = image.at(k, x, y) * (l > most ? most / l : 1);
        ASSERT_NEAR(out.at(k, x, y), expected, 2e-6 * std::max(1.0, expected)) << x << "," << y;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PercentileClamp,
                         testing::Values(Case{67, 21, 8, 0.1f, 0.9f, 1}, Case{40, 40, 8, 0.25f, 0.75f, 0},
                                         Case{17, 3, 5, 0, 1, 0}, Case{1, 9, 8, 0.5f, 0.5f, 2}, Case{1, 1, 2, 0, 1, 1},
                                         Case{130, 66, 64, 0.1f, 0.9f, 0.5f}));

TEST(PercentileClamp, RefusesPercentilesInTheWrongOrder) {
  const auto image = noise_image(8, 8, 3, 76);
  Node node("percentile_clamp");
  node.set("low", 0.9f).set("high", 0.1f).in("image", image);
  EXPECT_EQ(failure([&] { node.run("image"); }), "low is 0.900000 and high is 0.100000: low must not exceed high");
}

}  // namespace
}  // namespace quell::test
