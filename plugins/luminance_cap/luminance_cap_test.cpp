// luminance_cap against its formula in double precision.
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace quell::test {
namespace {

struct Case {
  int width, height, radius, rank;  // rank 0: the mean
  float margin;
};

double luminance(const Image& i, int x, int y) {
  return 0.2126 * i.at(0, x, y) + 0.7152 * i.at(1, x, y) + 0.0722 * i.at(2, x, y);
}

double share(const Image& image, const Case& c, int x, int y) {
  std::vector<double> list;
  for (int v = std::max(0, y - c.radius); v <= std::min(c.height - 1, y + c.radius); ++v)
    for (int u = std::max(0, x - c.radius); u <= std::min(c.width - 1, x + c.radius); ++u)
      if (u != x || v != y) list.push_back(luminance(image, u, v));
  if (list.empty() || int(list.size()) < c.rank) return 1;
  std::ranges::sort(list, std::greater());
  double sum = 0;
  for (const double l : list) sum += l;
  const double cap = (c.rank ? list[std::size_t(c.rank - 1)] : sum / double(list.size())) * (1 + double(c.margin));
  const double l = luminance(image, x, y);
  return l > cap ? cap / l : 1;
}

class LuminanceCap : public testing::TestWithParam<Case> {};

// A luminance is held to 1e-7 of itself, their mean and quotient to a few times that.
TEST_P(LuminanceCap, IsItsFormula) {
  const auto c = GetParam();
  auto image = noise_image(c.width, c.height, 3, 74);
  for (int y = 0; y < c.height; y += 3)
    for (int x = y % 2; x < c.width; x += 5) {
      image.at(0, x, y) = 500;
      if (x + 1 < c.width)
        for (int k = 0; k < 3; ++k) image.at(k, x + 1, y) = 0;
    }
  Node node("luminance_cap");
  node.set("cap", c.rank ? "brightest" : "mean").set("radius", c.radius).set("margin", c.margin).in("image", image);
  if (c.rank) node.set("rank", c.rank);
  for_each_target([&] {
    const auto out = node.run("image");
    for (int y = 0; y < c.height; ++y)
      for (int x = 0; x < c.width; ++x)
        for (int k = 0; k < 3; ++k) {
          const double expected = image.at(k, x, y) * share(image, c, x, y);
          ASSERT_NEAR(out.at(k, x, y), expected, 2e-6 * std::max(expected, 1e-3)) << x << "," << y;
        }
  });
}

INSTANTIATE_TEST_SUITE_P(Sizes, LuminanceCap,
                         testing::Values(Case{67, 21, 1, 1, 0}, Case{67, 21, 1, 0, 0.414f}, Case{67, 21, 2, 2, 0.5f},
                                         Case{33, 9, 3, 4, 0}, Case{17, 3, 3, 0, 0}, Case{1, 1, 1, 1, 0},
                                         Case{1, 1, 1, 0, 0}, Case{1, 9, 1, 1, 0}, Case{2, 2, 1, 4, 0}));

// What is capped at its brightest neighbour has nothing left to cap but through neighbours that were dimmed too.
TEST(LuminanceCap, OnePixelIsTakenAtOnce) {
  auto image = constant_image(15, 15, 3, 0.5f);
  for (int c = 0; c < 3; ++c) image.at(c, 7, 7) = 1e5f;
  Node once("luminance_cap");
  const auto out = once.in("image", image).run("image");
  EXPECT_NEAR(out.at(0, 7, 7), 0.5, 1e-6);
}

}  // namespace
}  // namespace quell::test
