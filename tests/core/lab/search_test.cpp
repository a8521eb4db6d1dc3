// The search over functions whose least value is known.
#include "core/lab/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace quell {
namespace {

TEST(Search, FindsTheBottomOfABowl) {
  const std::vector<SearchRange> ranges{{0, 10, 5}, {0.01, 100, 1, true}};
  const auto found = search(ranges, 500, 1e-5, [](std::span<const double> x) {
    return std::pow(x[0] - 7, 2) + std::pow(std::log(x[1] / 20), 2) + 1;
  });
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.best[0], 7, 1e-2);
  EXPECT_NEAR(found.best[1], 20, 0.1);
  EXPECT_NEAR(found.value, 1, 1e-4);
}

TEST(Search, StaysWithinTheRanges) {
  const std::vector<SearchRange> ranges{{-1, 2, 0}, {1, 5, 3, false, true}};
  const auto found = search(ranges, 200, 1e-4, [](std::span<const double> x) {
    EXPECT_GE(x[0], -1);
    EXPECT_LE(x[0], 2);
    EXPECT_EQ(x[1], std::round(x[1]));
    return x[0] - x[1];
  });
  EXPECT_NEAR(found.best[0], -1, 1e-3);
  EXPECT_EQ(found.best[1], 5);
}

TEST(Search, TriesTheSamePointsInTheSameOrder) {
  const auto tried = [] {
    std::vector<double> all;
    const std::vector<SearchRange> ranges{{0, 1, 0.5}, {0, 1, 0.5}};
    search(ranges, 60, 1e-6, [&](std::span<const double> x) {
      all.insert(all.end(), x.begin(), x.end());
      return std::pow(x[0] - 0.3, 2) + 10 * std::pow(x[1] - x[0] * x[0], 2);
    });
    return all;
  };
  EXPECT_EQ(tried(), tried());
}

TEST(Search, EndsAfterAsManyEvaluationsAsWereAllowed) {
  int calls = 0;
  const std::vector<SearchRange> ranges{{0, 1, 0.5}};
  const auto found = search(ranges, 7, 0, [&](std::span<const double> x) { return ++calls, std::pow(x[0] - 0.7, 2); });
  EXPECT_EQ(calls, 7);
  EXPECT_EQ(found.evaluations, 7);
  EXPECT_FALSE(found.converged);
}

TEST(Search, WhatIsNoNumberIsWorseThanAny) {
  const std::vector<SearchRange> ranges{{0, 1, 0.4}};
  const auto found = search(ranges, 100, 1e-4, [](std::span<const double> x) {
    return x[0] < 0.5 ? std::numeric_limits<double>::quiet_NaN() : x[0];
  });
  EXPECT_GE(found.best[0], 0.5);
  EXPECT_NEAR(found.best[0], 0.5, 0.01);
}

TEST(Search, PassesExceptionsOn) {
  const std::vector<SearchRange> ranges{{0, 1, 0.5}};
  EXPECT_THROW(search(ranges, 10, 1e-4, [](std::span<const double>) -> double { throw std::runtime_error("no"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace quell
