// sanitize: what is bad, what takes its place, and what it says.
#include "tests/support/failure.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace quell::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

// Bad pixels: (2,1) by NaN, (3,1) by infinity, (0,0) by its size, (6,3) by a negative number.
Image spoilt() {
  auto image = noise_image(9, 5, 3, 91);
  image.at(1, 2, 1) = kNan, image.at(2, 3, 1) = -kInf, image.at(0, 0, 0) = 70000, image.at(0, 6, 3) = -0.5f;
  return image;
}

bool is_bad(int x, int y, bool negative) {
  return (y == 1 && (x == 2 || x == 3)) || (x == 0 && y == 0) || (!negative && x == 6 && y == 3);
}

TEST(Sanitize, ReplacesAndMarks) {
  const auto image = spoilt();
  for (const char* policy : {"neighbours", "zero"})
    for (const bool negative : {true, false}) {
      SCOPED_TRACE(testing::Message() << policy << " " << negative);
      Node node("sanitize");
      const auto out = node.set("policy", policy).set("negative", negative).in("image", image).run();
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) {
          const bool bad = is_bad(x, y, negative);
          EXPECT_EQ(out[1].at(0, x, y), bad ? 1 : 0);
          for (int c = 0; c < 3; ++c) {
            double sum = 0;
            int count = 0;
            for (int v = std::max(0, y - 1); v <= std::min(4, y + 1); ++v)
              for (int u = std::max(0, x - 1); u <= std::min(8, x + 1); ++u)
                if (!is_bad(u, v, negative)) sum += image.at(c, u, v), ++count;
            const double expected = !bad ? image.at(c, x, y) : policy[0] == 'n' ? sum / count : 0;
            EXPECT_NEAR(out[0].at(c, x, y), expected, 1e-7) << x << "," << y;
          }
        }
    }
}

TEST(Sanitize, NothingGoodAroundLeavesZero) {
  auto image = constant_image(3, 1, 2, kNan);
  Node node("sanitize");
  const auto out = node.in("image", image).run("image");
  for (int x = 0; x < 3; ++x) EXPECT_EQ(out.at(1, x, 0), 0);
}

TEST(Sanitize, NamesThePixel) {
  auto image = constant_image(8, 4, 3, 0.5f);
  image.at(1, 5, 2) = kInf;
  Node node("sanitize");
  node.set("policy", "error").in("image", image);
  EXPECT_EQ(failure([&] { node.run("image"); }),
            "pixel (5, 2) has inf in channel 1, counted from 0; policy neighbours or zero would replace it");
}

}  // namespace
}  // namespace quell::test
