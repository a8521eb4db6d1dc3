// halve against averages written out.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace quell::test {
namespace {

TEST(Halve, AveragesBlocks) {
  for (const int channels : {1, 3, 5})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {8, 4}, {17, 3}}) {
      const auto image = noise_image(width, height, channels, 3, -2, 2);
      const auto half = Node("halve").in("image", image).run("image");
      ASSERT_EQ(half.width(), (width + 1) / 2);
      ASSERT_EQ(half.height(), (height + 1) / 2);
      for (int c = 0; c < channels; ++c)
        for (int y = 0; y < half.height(); ++y)
          for (int x = 0; x < half.width(); ++x) {
            double sum = 0;
            for (int j = 0; j < 2; ++j)
              for (int i = 0; i < 2; ++i)
                sum += image.at(c, std::min(2 * x + i, width - 1), std::min(2 * y + j, height - 1));
            EXPECT_NEAR(half.at(c, x, y), sum / 4, 2e-7);  // three roundings of numbers up to 2
          }
    }
}

TEST(Halve, KeepsConstants) {
  const auto half = Node("halve").in("image", constant_image(7, 5, 3, 3e38f)).run("image");
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(half.at(1, x, y), 3e38f);
}

}  // namespace
}  // namespace quell::test
