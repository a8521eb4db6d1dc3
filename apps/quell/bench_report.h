// Measurements and comparisons for people.
#pragma once

#include "core/bench/compare.h"

#include <string>

namespace quell {

// A table of nodes, the whole graph, memory.
std::string timing_text(const Timing&);
// A table of what changed since the baseline called `name`.
std::string comparison_text(const TimingComparison&, const std::string& name);

}  // namespace quell
