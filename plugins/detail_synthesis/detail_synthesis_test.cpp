// detail_synthesis against its formula, and that it undoes the transform.
#include "tests/support/run_node.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace quell::test {
namespace {

// The input and three levels of an edge-avoiding transform.
std::vector<Image> levels(const Image& image) {
  std::vector<Image> list;
  list.push_back(image.copy());
  for (const int step : {1, 2, 4}) {
    Node by_color("color_weight"), atrous("atrous");
    by_color.set("sigma", 0.4f).in("image", list.back());
    list.push_back(atrous.set("step", step).in("image", list.back()).in("weights", by_color).run("image"));
  }
  return list;
}

Image synthesis(const std::vector<Image>& list, std::vector<float> share) {
  share.resize(8);
  Node node("detail_synthesis");
  for (const auto& level : list) node.in("levels", level);
  return node.set("share", share).run("image");
}

TEST(DetailSynthesis, IsItsFormula) {
  const auto list = levels(noise_image(67, 21, 3, 83));
  const double share[] = {0.2, 0.7, 0.4};
  const auto out = synthesis(list, {0.2f, 0.7f, 0.4f});
  EXPECT_LE(largest_difference(out,
                               [&](int c, int x, int y) {
                                 double sum = list[3].at(c, x, y);
                                 for (std::size_t i = 0; i < 3; ++i)
                                   sum += share[i] * (double(list[i].at(c, x, y)) - list[i + 1].at(c, x, y));
                                 return std::max(sum, 0.0);
                               }),
            5e-7);
}

TEST(DetailSynthesis, AllReconstructsTheInputAndNoneIsTheLastLevel) {
  const auto list = levels(noise_image(67, 21, 3, 84));
  EXPECT_TRUE(same_bits(synthesis(list, {1, 1, 1}), list.front()));
  EXPECT_TRUE(same_bits(synthesis(list, {0, 0, 0}), list.back()));
}

}  // namespace
}  // namespace quell::test
