// Two measurements side by side.
#include "core/bench/compare.h"

#include "core/report/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quell {

namespace {

constexpr double kShare = 0.03, kClock = 0.05;

std::string shown(const Timing& m) { return fmt::format("{} at {}x{}", m.input, m.width, m.height); }

}  // namespace

Pace pace(const Spread& before, const Spread& now) {
  const double noise = std::max({before.quartiles_apart(), now.quartiles_apart(), kShare * before.median, kClock});
  const double change = now.median - before.median;
  if (std::abs(change) <= noise) return Pace::same;
  return change > 0 ? Pace::slower : Pace::faster;
}

TimingComparison compare(const Timing& before, const Timing& now) {
  if (before.width != now.width || before.height != now.height || before.input != now.input)
    throw Error(Exit::usage, fmt::format("the baseline was measured on {}, this on {}; measure both on the same",
                                         shown(before), shown(now)));
  TimingComparison c;
  if (before.fingerprint != now.fingerprint)
    c.notes.push_back(fmt::format("the graphs differ: '{}' ({}) before, '{}' ({}) now", before.graph,
                                  before.fingerprint, now.graph, now.fingerprint));
  if (before.threads != now.threads)
    c.notes.push_back(fmt::format("{} threads before, {} now", before.threads, now.threads));
  if (before.simd != now.simd) c.notes.push_back(fmt::format("{} before, {} now", before.simd, now.simd));
  c.total = {"whole graph", before.ms, now.ms, pace(before.ms, now.ms)};
  const auto same_node = [](const NodeTiming& a) {
    return [&a](const NodeTiming& b) { return a.name == b.name && a.type == b.type; };
  };
  for (const auto& n : now.nodes) {
    if (const auto it = std::ranges::find_if(before.nodes, same_node(n)); it != before.nodes.end())
      c.nodes.push_back({n.name, it->ms, n.ms, pace(it->ms, n.ms)});
    else
      c.added.push_back(n.name);
  }
  for (const auto& n : before.nodes)
    if (std::ranges::none_of(now.nodes, same_node(n))) c.removed.push_back(n.name);
  return c;
}

bool slower_by(const TimingComparison& c, double percent) {
  const auto slower = [&](const TimeChange& change) {
    return change.pace == Pace::slower && change.percent() > percent;
  };
  return slower(c.total) || std::ranges::any_of(c.nodes, slower);
}

}  // namespace quell
