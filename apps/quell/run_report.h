// What a run took, for people and for machines.
#pragma once

#include "core/graph/graph.h"
#include "core/run/executor.h"

#include <string>

namespace quell {

// Two lines: frames, time, how it divides between reading, filtering and writing, memory.
std::string summary_text(const RunReport&);
// A table: milliseconds a frame and share of each node.
std::string times_text(const RunReport&);
// The same as JSON, to a file or, for "-", to stdout. Throws Error(Exit::resources).
void write_report(const std::string& path, const Graph&, const RunReport&);

}  // namespace quell
