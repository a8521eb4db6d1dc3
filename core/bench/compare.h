// Two measurements side by side, with a verdict that knows noise.
#pragma once

#include "core/bench/timing.h"

#include <string>
#include <vector>

namespace quell {

enum class Pace { same, faster, slower };

struct TimeChange {
  std::string name;
  Spread before, now;  // ms
  Pace pace = Pace::same;
  double percent() const { return before.median > 0 ? 100 * (now.median / before.median - 1) : 0; }
};

struct TimingComparison {
  TimeChange total;
  std::vector<TimeChange> nodes;            // of one name and type in both, in the order of now
  std::vector<std::string> added, removed;  // nodes that only the one has
  std::vector<std::string> notes;           // what else differs between the two: graph, threads, SIMD
};

// The medians differ when they lie farther apart than the quartiles of either, than 3 % of the former and than what a
// clock and a scheduler add of themselves (0.05 ms).
Pace pace(const Spread& before, const Spread& now);

// Throws Error(Exit::usage) when the two are of different sizes or inputs, which no verdict could mean anything for.
TimingComparison compare(const Timing& before, const Timing& now);

// Whether anything, node or whole, is slower by more than this.
bool slower_by(const TimingComparison&, double percent);

}  // namespace quell
