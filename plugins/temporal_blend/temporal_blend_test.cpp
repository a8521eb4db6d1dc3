// Blending against its formula; means, fixed points and the variance of a long average.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

Image blend(const Image& current, const Image& history, const Image& count, float alpha, bool warm_up = true) {
  return Node("temporal_blend")
      .set("alpha", alpha)
      .set("warm_up", warm_up)
      .in("current", current)
      .in("history", history)
      .in("count", count)
      .run("image");
}

TEST(TemporalBlend, FollowsItsFormula) {
  for_each_target([&] {
    const auto current = noise_image(17, 3, 3, 1, 0, 10), history = noise_image(17, 3, 3, 2, 0, 10);
    const auto count = noise_image(17, 3, 1, 3, 0, 12);
    for (const bool warm_up : {true, false}) {
      const auto out = blend(current, history, count, 0.2f, warm_up);
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 3; ++y)
          for (int x = 0; x < 17; ++x) {
            const double n = count.at(0, x, y), now = current.at(c, x, y), then = history.at(c, x, y);
            const double a = n <= 1 ? 1 : warm_up ? std::max(double(0.2f), 1 / n) : double(0.2f);
            EXPECT_NEAR(out.at(c, x, y), a * now + (1 - a) * then, 2e-6);
          }
    }
  });
}

TEST(TemporalBlend, TakesAFactorOnAlpha) {
  for_each_target([&] {
    const auto current = noise_image(17, 3, 3, 1, 0, 10), history = noise_image(17, 3, 3, 2, 0, 10);
    const auto count = noise_image(17, 3, 1, 3, 0, 12), factor = noise_image(17, 3, 1, 4);
    for (const bool warm_up : {true, false}) {
      const auto out = Node("temporal_blend")
                           .set("warm_up", warm_up)
                           .in("current", current)
                           .in("history", history)
                           .in("count", count)
                           .in("factor", factor)
                           .run("image");
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 3; ++y)
          for (int x = 0; x < 17; ++x) {
            const double n = count.at(0, x, y), now = current.at(c, x, y), then = history.at(c, x, y);
            const double alpha = double(0.2f) * factor.at(0, x, y);
            const double a = n <= 1 ? 1 : warm_up ? std::max(alpha, 1 / n) : alpha;
            EXPECT_NEAR(out.at(c, x, y), a * now + (1 - a) * then, 2e-6);
          }
    }
  });
}

TEST(TemporalBlend, GivesTheCurrentFrameToTheBitWhereItMust) {
  for_each_target([&] {
    const auto current = noise_image(17, 3, 3, 1), history = noise_image(17, 3, 3, 2, 0, 1e6f);
    const auto first = blend(current, history, constant_image(17, 3, 1, 1), 0.2f);
    const auto none = blend(current, history, constant_image(17, 3, 1, 0), 0.2f);
    const auto whole = blend(current, history, constant_image(17, 3, 1, 20), 1.0f);
    const auto same = blend(current, current, constant_image(17, 3, 1, 7), 0.2f);
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 17; ++x) {
          EXPECT_EQ(first.at(c, x, y), current.at(c, x, y));
          EXPECT_EQ(none.at(c, x, y), current.at(c, x, y));
          EXPECT_EQ(whole.at(c, x, y), current.at(c, x, y));
          EXPECT_EQ(same.at(c, x, y), current.at(c, x, y));
        }
  });
}

TEST(TemporalBlend, OfTheFirstFramesIsTheirMean) {
  for_each_target([&] {
    Image average(17, 3, 1);
    double sum[17] = {};
    for (int n = 1; n <= 5; ++n) {
      const auto frame = noise_image(17, 3, 1, std::uint32_t(n));
      average = blend(frame, n == 1 ? frame : average, constant_image(17, 3, 1, float(n)), 0.2f);
      for (int x = 0; x < 17; ++x) {
        sum[x] += frame.at(0, x, 1);
        EXPECT_NEAR(average.at(0, x, 1), sum[x] / n, 1e-6);
      }
    }
  });
}

TEST(TemporalBlend, KeepsTheShareOfVarianceThatAlphaPredicts) {
  // An exponential average of independent frames has the variance alpha / (2 - alpha) of one of them.
  const int size = 128;
  const float alpha = 0.2f;
  auto average = noise_image(size, size, 1, 1, -1, 1);
  for (std::uint32_t n = 2; n < 40; ++n)
    average = blend(noise_image(size, size, 1, n * 7919, -1, 1), average, constant_image(size, size, 1, 50), alpha);
  double squares = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) squares += double(average.at(0, x, y)) * average.at(0, x, y);
  const double one_frame = 1.0 / 3, expected = one_frame * alpha / (2 - alpha);
  // 16384 samples: a relative standard error of 1.1 %.
  EXPECT_NEAR(squares / (size * size), expected, 0.05 * expected);
}

}  // namespace
