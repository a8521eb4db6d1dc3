// Places buffers with known lifetimes into one arena.
#include "core/run/intervals.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace quell {

std::size_t place(std::vector<Interval>& intervals) {
  std::vector<std::size_t> order(intervals.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](auto a, auto b) { return intervals[a].size > intervals[b].size; });

  std::vector<const Interval*> placed;
  std::size_t total = 0;
  for (const auto i : order) {
    auto& interval = intervals[i];
    // What is in the way, from low to high, and the smallest gap between.
    std::vector<const Interval*> neighbours;
    for (const auto* p : placed)
      if (p->first <= interval.last && interval.first <= p->last) neighbours.push_back(p);
    std::ranges::sort(neighbours, {}, &Interval::offset);
    std::size_t end = 0, best = std::numeric_limits<std::size_t>::max(), best_gap = best;
    for (const auto* n : neighbours) {
      if (n->offset > end && n->offset - end >= interval.size && n->offset - end < best_gap)
        best = end, best_gap = n->offset - end;
      end = std::max(end, n->offset + n->size);
    }
    interval.offset = best_gap == std::numeric_limits<std::size_t>::max() ? end : best;
    total = std::max(total, interval.offset + interval.size);
    placed.push_back(&interval);
  }
  return total;
}

}  // namespace quell
