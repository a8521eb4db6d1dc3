// The arena planner: no two buffers that live at once overlap, and memory is reused.
#include "core/run/intervals.h"

#include <gtest/gtest.h>

#include <random>

namespace quell {
namespace {

bool overlap(const Interval& a, const Interval& b) {
  const bool in_time = a.first <= b.last && b.first <= a.last;
  const bool in_space = a.offset < b.offset + b.size && b.offset < a.offset + a.size;
  return in_time && in_space;
}

TEST(Intervals, AChainNeedsTwoBuffers) {
  std::vector<Interval> chain;
  for (int i = 0; i < 10; ++i) chain.push_back({i, i + 1, 100});
  EXPECT_EQ(place(chain), 200u);
}

TEST(Intervals, NeverOverlap) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<Interval> list;
    std::size_t sum = 0;
    for (int i = 0; i < 60; ++i) {
      const int first = int(random() % 30);
      list.push_back({first, first + int(random() % 8), 1 + random() % 1000});
      sum += list.back().size;
    }
    const std::size_t total = place(list);
    std::size_t peak = 0;
    for (int step = 0; step < 40; ++step) {
      std::size_t live = 0;
      for (const auto& i : list) live += i.first <= step && step <= i.last ? i.size : 0;
      peak = std::max(peak, live);
    }
    EXPECT_GE(total, peak);
    EXPECT_LE(total, sum);
    EXPECT_LE(double(total), 1.5 * double(peak));
    for (std::size_t a = 0; a < list.size(); ++a) {
      EXPECT_LE(list[a].offset + list[a].size, total);
      for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(overlap(list[a], list[b])) << a << " and " << b;
    }
  }
}

TEST(Intervals, NothingTakesNothing) {
  std::vector<Interval> none;
  EXPECT_EQ(place(none), 0u);
}

}  // namespace
}  // namespace quell
