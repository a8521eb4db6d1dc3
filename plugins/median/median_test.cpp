// median against sorting each window.
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace quell::test {
namespace {

float median(const Image& image, int c, int x, int y, int radius) {
  std::vector<float> list;
  for (int v = std::max(0, y - radius); v <= std::min(image.height() - 1, y + radius); ++v)
    for (int u = std::max(0, x - radius); u <= std::min(image.width() - 1, x + radius); ++u)
      list.push_back(image.at(c, u, v));
  std::ranges::sort(list);
  return list[(list.size() - 1) / 2];
}

TEST(Median, SelectsAsSortingDoes) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {17, 3}, {83, 29}})
    for (const int radius : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height << " radius " << radius);
      const auto image = noise_image(width, height, 2, 81, -1, 1);
      Node node("median");
      node.set("radius", radius).in("image", image);
      for_each_target([&] {
        const auto out = node.run("image");
        for (int c = 0; c < 2; ++c)
          for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) ASSERT_EQ(out.at(c, x, y), median(image, c, x, y, radius)) << x << "," << y;
      });
    }
}

// Up to (n - 1) / 2 outliers of a window are of no influence: here 24 of 49.
TEST(Median, OutlivesOutliers) {
  auto image = constant_image(30, 30, 1, 1.0f);
  const auto dice = noise_image(30, 30, 1, 82);
  int outliers = 0;
  for (int y = 12; y < 19; ++y)
    for (int x = 12; x < 19; ++x)
      if (dice.at(0, x, y) < 0.6f && outliers < 24) image.at(0, x, y) = 1e8f, ++outliers;
  ASSERT_EQ(outliers, 24);
  Node node("median");
  EXPECT_EQ(node.set("radius", 3).in("image", image).run("image").at(0, 15, 15), 1);
}

}  // namespace
}  // namespace quell::test
