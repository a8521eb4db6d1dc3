// Runs a shipped metric on frames made in a test, joined to a graph as studies join it.
#pragma once

#include "core/graph/variant.h"
#include "tests/support/run_graph.h"

#include <map>
#include <string>
#include <vector>

namespace quell::test {

// Of one frame: "image", "reference" and the other roles that the metric reads. Images are borrowed.
using JudgedFrame = std::map<std::string, GraphImage>;

struct Verdict {
  double value = 0;
  double pixels = -1;  // -1: the metric does not say
  Image map;           // empty: it has none
};

// One a frame. Throws what loading or running report.
std::vector<Verdict> judge(const std::string& metric, const std::vector<JudgedFrame>& frames,
                           std::vector<Edit> edits = {});

// A single frame of radiance.
Verdict judge(const std::string& metric, const Image& image, const Image& reference, std::vector<Edit> edits = {});
// By two halves of a reference.
Verdict judge(const std::string& metric, const Image& image, const Image& a, const Image& b);

}  // namespace quell::test
