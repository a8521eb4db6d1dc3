// Summaries of numbers, against values worked out by hand and a table of Student's t.
#include "core/lab/summary.h"

#include <gtest/gtest.h>

#include <vector>

namespace quell {
namespace {

TEST(Summary, OfFiveNumbers) {
  const std::vector<double> numbers{5, 1, 4, 2, 3};
  const auto s = summarize(numbers);
  EXPECT_EQ(s.count, 5u);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_EQ(s.minimum, 1);
  EXPECT_EQ(s.maximum, 5);
  // Standard deviation sqrt(2.5), of the mean sqrt(0.5), times t of 4 degrees.
  EXPECT_NEAR(s.high - s.mean, 2.776445 * 0.70710678, 1e-5);
  EXPECT_NEAR(s.mean - s.low, s.high - s.mean, 1e-12);
}

TEST(Summary, OfOneNumberAndOfNone) {
  const auto one = summarize(std::vector<double>{7});
  EXPECT_EQ(one.low, 7);
  EXPECT_EQ(one.high, 7);
  EXPECT_EQ(one.median, 7);
  EXPECT_EQ(one.p95, 7);
  EXPECT_EQ(summarize({}).count, 0u);
}

TEST(Summary, StudentsT) {
  EXPECT_NEAR(student_t_95(1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t_95(2), 4.30265, 1e-5);
  EXPECT_NEAR(student_t_95(10), 2.228139, 1e-6);
  EXPECT_NEAR(student_t_95(30), 2.042272, 1e-6);
  EXPECT_NEAR(student_t_95(100000), 1.959988, 1e-5);
}

}  // namespace
}  // namespace quell
