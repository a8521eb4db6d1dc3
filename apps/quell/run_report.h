// What a run took, for people and for machines.
#pragma once

#include "apps/quell/file_sink.h"
#include "core/graph/graph.h"
#include "core/run/executor.h"

#include <span>
#include <string>

namespace quell {

// Two lines: frames, time, how it divides between reading, filtering and writing, memory.
std::string summary_text(const RunReport&);
// A table: milliseconds a frame and share of each node.
std::string times_text(const RunReport&);
// A line for each output of type value: its mean and range over the frames.
std::string values_text(std::span<const ReportedValue>);
// All of that and how it came to be as JSON, to a file or, for "-", to stdout. Throws Error(Exit::resources).
void write_report(const std::string& path, const Graph&, const RunReport&, std::span<const ReportedValue>,
                  const Provenance&);

}  // namespace quell
