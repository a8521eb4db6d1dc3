// percentile against sorting.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace quell::test {
namespace {

TEST(Percentile, IsItsPlaceInOrder) {
  for (const int channels : {1, 2, 3})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {41, 17}}) {
      const auto image = noise_image(width, height, channels, 4, -1, 3),
                 mask = noise_image(width, height, 1, 5, -0.3f, 1);
      for (const bool positive : {false, true})
        for (const float share : {0.0f, 0.1f, 0.5f, 0.999f, 1.0f}) {
          std::vector<double> values;
          for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
              const double v =
                  channels == 3 ? 0.2126 * image.at(0, x, y) + 0.7152 * image.at(1, x, y) + 0.0722 * image.at(2, x, y)
                                : image.at(0, x, y);
              if (mask.at(0, x, y) > 0 && (!positive || v > 0)) values.push_back(v);
            }
          std::ranges::sort(values);
          const auto at = std::min(std::size_t(double(share) * double(values.size())), values.size() - 1);
          Node node("percentile");
          node.set("share", share).set("positive", positive).in("image", image).in("mask", mask);
          EXPECT_EQ(node.run("value").at(0, 0, 0), values.empty() ? 0.0f : float(values[at])) << share;
        }
    }
}

// Half of what is stacked up in ascending order.
TEST(Percentile, WeighsNumbersByThemselves) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {41, 17}}) {
    const auto image = noise_image(width, height, 1, 6, -0.2f, 1), mask = noise_image(width, height, 1, 7, -0.3f, 1);
    std::vector<double> values;
    double all = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (mask.at(0, x, y) > 0 && image.at(0, x, y) >= 0)
          values.push_back(image.at(0, x, y)), all += image.at(0, x, y);
    std::ranges::sort(values);
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      std::size_t at = 0;
      double below = values.empty() ? 0 : values[0];
      while (at + 1 < values.size() && below <= share * all) below += values[++at];
      Node node("percentile");
      node.set("share", float(share)).set("weighted", true).in("image", image).in("mask", mask);
      EXPECT_EQ(node.run("value").at(0, 0, 0), values.empty() ? 0.0f : float(values[at])) << share;
    }
  }
}

// 1 + 2 + 3 + 4 = 10: the first three make up 6 of it and the first two 3, whatever order they come in.
TEST(Percentile, WeightedMedianIsNoMedian) {
  auto image = constant_image(7, 1, 1, 0);
  image.at(0, 0, 0) = 4, image.at(0, 2, 0) = 1, image.at(0, 4, 0) = 3, image.at(0, 5, 0) = 2;
  const auto at = [&](float share, bool weighted) {
    return Node("percentile").set("share", share).set("weighted", weighted).in("image", image).run("value").at(0, 0, 0);
  };
  EXPECT_EQ(at(0.5f, true), 3.0f);
  EXPECT_EQ(at(0.25f, true), 2.0f);
  EXPECT_EQ(at(0.75f, true), 4.0f);
  EXPECT_EQ(at(1.0f, true), 4.0f);
  EXPECT_EQ(at(0.5f, false), 1.0f);
}

TEST(Percentile, OfNothingIsZero) {
  const auto black = constant_image(5, 5, 3, 0);
  EXPECT_EQ(Node("percentile").set("positive", true).in("image", black).run("value").at(0, 0, 0), 0.0f);
  EXPECT_EQ(Node("percentile").set("weighted", true).in("image", black).run("value").at(0, 0, 0), 0.0f);
}

}  // namespace
}  // namespace quell::test
