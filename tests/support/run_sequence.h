// Runs a graph over a sequence inside a test, as `quell run` does, and keeps the images.
#pragma once

#include "core/graph/load.h"
#include "core/image/image.h"
#include "core/run/executor.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace quell::test {

struct SequenceRun {
  std::string graph;     // installed name or path
  std::string sequence;  // path
  std::string root;      // "" or in place of the sequence's own
  std::string frames;    // "" or in place of the sequence's own
  std::vector<Edit> edits;
  std::map<std::string, int> source_ints;  // parameters of a source node
  RunOptions options;
};

struct SequenceResult {
  std::vector<std::string> names;                     // of outputs
  std::map<std::int64_t, std::vector<Image>> images;  // by frame, one an output
  RunReport report;
};

// Throws std::runtime_error with the diagnostics when anything is wrong.
SequenceResult run_sequence(const SequenceRun&);

// The folder of real frames, or "" when QUELL_TEST_DATA is not set.
std::string test_data();

}  // namespace quell::test
