// Conditions on metrics: what they mean, and what is said of those that mean nothing.
#include "core/lab/threshold.h"

#include "tests/support/failure.h"

#include <gtest/gtest.h>

namespace quell::test {
namespace {

std::string refusal(const char* text) {
  return failure(Exit::usage, [&] { parse_threshold(text, "--fail"); });
}

TEST(Threshold, Relations) {
  EXPECT_TRUE(parse_threshold("flip > 0.05", "").met_by(0.06));
  EXPECT_FALSE(parse_threshold("flip > 0.05", "").met_by(0.05));
  EXPECT_TRUE(parse_threshold("flip>=0.05", "").met_by(0.05));
  EXPECT_TRUE(parse_threshold("psnr_ldr < 30", "").met_by(29.9));
  EXPECT_FALSE(parse_threshold("psnr_ldr<30", "").met_by(30));
  EXPECT_TRUE(parse_threshold(" psnr_ldr <= 3e1 ", "").met_by(30));
}

TEST(Threshold, Statistics) {
  const Summary s{5, 1, 2, 3, 4, 5, 0, 0};
  EXPECT_EQ(parse_threshold("flip > 1", "").of(s), 1);
  EXPECT_EQ(parse_threshold("flip.mean > 1", "").of(s), 1);
  EXPECT_EQ(parse_threshold("flip.median > 1", "").of(s), 2);
  EXPECT_EQ(parse_threshold("flip.p95 > 1", "").of(s), 3);
  EXPECT_EQ(parse_threshold("flip.min > 1", "").of(s), 4);
  EXPECT_EQ(parse_threshold("flip.max > 1", "").of(s), 5);
}

TEST(Threshold, Refusals) {
  EXPECT_EQ(refusal("flip"), "--fail 'flip': expected METRIC[.STATISTIC] > NUMBER or <, >=, <=, as in 'flip > 0.05'");
  EXPECT_EQ(refusal("> 3"), "--fail '> 3': no metric stands before the comparison");
  EXPECT_EQ(refusal("flip > much"), "--fail 'flip > much': 'much' is not a number");
  EXPECT_EQ(refusal("flip > 1 2"), "--fail 'flip > 1 2': '1 2' is not a number");
  EXPECT_EQ(refusal("flip > nan"), "--fail 'flip > nan': 'nan' is not a number");
  EXPECT_EQ(refusal("flip > "), "--fail 'flip > ': '' is not a number");
  EXPECT_EQ(refusal("flip.mode > 1"),
            "--fail 'flip.mode > 1': there is no statistic 'mode'; there are: mean, median, p95, min, max");
}

}  // namespace
}  // namespace quell::test
