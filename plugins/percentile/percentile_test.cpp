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

TEST(Percentile, OfNothingIsZero) {
  const auto black = constant_image(5, 5, 3, 0);
  EXPECT_EQ(Node("percentile").set("positive", true).in("image", black).run("value").at(0, 0, 0), 0.0f);
}

}  // namespace
}  // namespace quell::test
