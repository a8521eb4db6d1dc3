// outlier_rank against sorting each window.
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"
#include "tests/support/typical_input.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <vector>

namespace quell::test {
namespace {

struct Case {
  int width, height, radius, rank;
  bool ids;
};

double luminance(const Image& i, int x, int y) {
  return 0.2126 * i.at(0, x, y) + 0.7152 * i.at(1, x, y) + 0.0722 * i.at(2, x, y);
}

// The pixel that takes the place of (x, y). Luminances of random pixels differ by more than floats round.
std::pair<int, int> chosen(const Image& image, const Image& id, const Case& c, int x, int y) {
  struct Neighbour {
    double l;
    int x, y;
  };
  std::vector<Neighbour> list;
  for (int v = std::max(0, y - c.radius); v <= std::min(c.height - 1, y + c.radius); ++v)
    for (int u = std::max(0, x - c.radius); u <= std::min(c.width - 1, x + c.radius); ++u)
      if ((u != x || v != y) && (!c.ids || id.bits(0, v)[u] == id.bits(0, y)[x]))
        list.push_back({luminance(image, u, v), u, v});
  if (int(list.size()) < c.rank) return {x, y};
  std::ranges::stable_sort(list, {}, &Neighbour::l);
  const auto& least = list[std::size_t(c.rank - 1)];
  const auto& most = list[list.size() - std::size_t(c.rank)];
  const double l = luminance(image, x, y);
  if (l > most.l) return {most.x, most.y};
  if (l < least.l) return {least.x, least.y};
  return {x, y};
}

class OutlierRank : public testing::TestWithParam<Case> {};

TEST_P(OutlierRank, SelectsAsSortingDoes) {
  const auto c = GetParam();
  const auto image = noise_image(c.width, c.height, 3, 71), id = typical_input(QUELL_ID, c.width, c.height, 72);
  Node node("outlier_rank");
  node.set("radius", c.radius).set("rank", c.rank).in("image", image);
  if (c.ids) node.in("id", id);
  for_each_target([&] {
    const auto out = node.run("image");
    for (int y = 0; y < c.height; ++y)
      for (int x = 0; x < c.width; ++x) {
        const auto [u, v] = chosen(image, id, c, x, y);
        for (int k = 0; k < 3; ++k) ASSERT_EQ(out.at(k, x, y), image.at(k, u, v)) << x << "," << y;
      }
  });
}

INSTANTIATE_TEST_SUITE_P(Sizes, OutlierRank,
                         testing::Values(Case{67, 21, 1, 1, false}, Case{67, 21, 1, 1, true}, Case{67, 21, 2, 2, false},
                                         Case{67, 21, 2, 2, true}, Case{33, 9, 3, 3, false}, Case{17, 3, 3, 4, false},
                                         Case{1, 1, 1, 1, false}, Case{1, 9, 1, 1, false}, Case{2, 2, 1, 4, false}));

// One pixel is taken away, two hold each other up, and the second rank takes both away.
TEST(OutlierRank, PairsNeedTheSecondRank) {
  auto one = noise_image(9, 9, 3, 73), two = noise_image(9, 9, 3, 73);
  for (int c = 0; c < 3; ++c) one.at(c, 4, 4) = two.at(c, 4, 4) = 1000, two.at(c, 5, 4) = 900;
  const auto brightest = [](Node& node) {
    const auto out = node.run("image");
    float most = 0;
    for (int y = 0; y < 9; ++y) most = std::max(most, *std::max_element(out.row(1, y), out.row(1, y) + 9));
    return most;
  };
  for_each_target([&] {
    Node a("outlier_rank"), b("outlier_rank"), c("outlier_rank");
    EXPECT_LE(brightest(a.in("image", one)), 1);
    EXPECT_EQ(brightest(b.in("image", two)), 900);
    EXPECT_LE(brightest(c.in("image", two).set("radius", 2).set("rank", 2)), 1);
  });
}

TEST(OutlierRank, RampsStay) {
  Image ramp(40, 12, 3);
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 40; ++x) ramp.at(c, x, y) = float(x) + 0.25f * float(y) + float(c);
  Node node("outlier_rank");
  const auto out = node.in("image", ramp).run("image");
  for (int y = 1; y < 11; ++y)
    for (int x = 1; x < 39; ++x) ASSERT_EQ(out.at(0, x, y), ramp.at(0, x, y));
}

}  // namespace
}  // namespace quell::test
