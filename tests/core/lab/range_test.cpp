// Ranges of numbers that parameters are tried at.
#include "core/lab/range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace quell::test {
namespace {

TEST(Range, IsWalkedEvenlyOrByFactors) {
  EXPECT_DOUBLE_EQ(in_range(-1, 3, false, 0.25), 0);
  EXPECT_DOUBLE_EQ(in_range(2, 32, true, 0.25), 4);
  EXPECT_DOUBLE_EQ(in_range(32, 2, true, 0.25), 16);
}

// What is no error gives finite numbers in between.
TEST(Range, OfFloatsDoesNotOverflow) {
  const double most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::min();
  EXPECT_EQ(problem_of_range(-most, most, false), "");
  EXPECT_EQ(in_range(-most, most, false, 0.5), 0);
  EXPECT_EQ(problem_of_range(least, most, true), "");
  EXPECT_TRUE(std::isfinite(in_range(least, most, true, 0.75)));
  EXPECT_EQ(problem_of_range(0, 2 * most, false), "a range lies within ±3.4e+38, not at 6.805646932770577e+38");
  EXPECT_EQ(problem_of_range(1, 1e-40, true), "a range on a log scale lies above 1.18e-38, not at 1e-40");
  EXPECT_EQ(problem_of_range(-2, 1, true), "a range on a log scale lies above 0, not at -2");
}

TEST(Range, WritesSixDigitsHoweverSmall) {
  EXPECT_EQ(six_digits(2.0 / 3), 0.666667);
  EXPECT_EQ(six_digits(1e-310 / 2), 5e-311);
  EXPECT_EQ(six_digits(-1234567), -1234570);
}

}  // namespace
}  // namespace quell::test
