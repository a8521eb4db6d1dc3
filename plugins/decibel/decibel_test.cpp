// decibel against 10 log10 (peak² / error).
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

float decibels(float error, float peak = 0) {
  const auto e = constant_image(1, 1, 1, error), p = constant_image(1, 1, 1, peak);
  Node node("decibel");
  node.in("error", e);
  if (peak > 0) node.in("peak", p);
  return node.run("decibels").at(0, 0, 0);
}

TEST(Decibel, IsItsFormula) {
  for (const float error : {1e-12f, 0.01f, 0.25f, 1.0f, 700.0f}) {
    EXPECT_NEAR(decibels(error), -10 * std::log10(double(error)), 1e-5);  // the rounding of a float up to 128
    EXPECT_NEAR(decibels(error, 8), 20 * std::log10(8.0) - 10 * std::log10(double(error)), 1e-5);
  }
  EXPECT_FLOAT_EQ(decibels(0.1f * 0.1f), 20.0f) << "X = Y + δ gives -20 log10 δ";
}

TEST(Decibel, EndsWhereThereIsNoError) {
  EXPECT_EQ(decibels(0), 1000.0f);
  EXPECT_EQ(decibels(-1e-9f), 1000.0f) << "an unbiased estimate may be";
}

TEST(Decibel, EndsWhereThereIsNoSignal) {
  const auto black = constant_image(1, 1, 1, 0), error = constant_image(1, 1, 1, 1);
  EXPECT_EQ(Node("decibel").in("error", error).in("peak", black).run("decibels").at(0, 0, 0), -1000.0f);
}

}  // namespace
}  // namespace quell::test
