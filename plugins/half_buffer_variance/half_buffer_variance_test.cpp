// half_buffer_variance against its formula, and against the variance that it estimates.
#include "tests/support/run_node.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

namespace quell::test {
namespace {

constexpr double kShare[] = {0.2126, 0.7152, 0.0722};

TEST(HalfBufferVariance, IsItsFormula) {
  const auto a = noise_image(67, 21, 3, 86), b = noise_image(67, 21, 3, 87);
  Node node("half_buffer_variance");
  const auto out = node.in("a", a).in("b", b).run();
  EXPECT_LE(
      largest_difference(out[0], [&](int c, int x, int y) { return (double(a.at(c, x, y)) + b.at(c, x, y)) / 2; }),
      1e-7);
  EXPECT_LE(largest_difference(out[1],
                               [&](int, int x, int y) {
                                 double l = 0;
                                 for (int c = 0; c < 3; ++c) l += kShare[c] * (double(a.at(c, x, y)) - b.at(c, x, y));
                                 return l * l / 4;
                               }),
            1e-7);
}

// Uniform noise in [0, 1) has variance 1/12 a channel; the mean of two buffers half of that, and the luminance of it
// that times the sum of the squared shares. Over 40,000 pixels the estimate is good to a percent or so.
TEST(HalfBufferVariance, EstimatesTheVarianceOfTheMean) {
  const auto a = noise_image(200, 200, 3, 88), b = noise_image(200, 200, 3, 89);
  Node node("half_buffer_variance");
  const auto out = node.in("a", a).in("b", b).run("variance");
  double mean = 0, squares = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) mean += out.at(0, x, y) / 40000.0;
  for (const double s : kShare) squares += s * s;
  EXPECT_NEAR(mean / (squares / 24), 1, 0.04);
}

}  // namespace
}  // namespace quell::test
