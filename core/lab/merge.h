// Many graphs as one, in which equal work exists once: what variants of a graph have in common is computed for all.
#pragma once

#include "core/graph/graph.h"

#include <span>
#include <string>
#include <vector>

namespace quell {

struct MergePart {
  std::string name;
  const Graph* graph;
};

struct Merged {
  Graph graph;                           // its outputs are called "part/output", in the order of the parts
  std::vector<std::vector<int>> places;  // by part and node of it: the node that stands for it
};

// Two nodes are one when type, version and parameters are equal and every wire of theirs reads, with one delay and one
// start, what is one again; so equal feedback loops are one too. Each output has the bits that its part alone gives:
// equal nodes begin alike, without a past, and read alike ever after. Throws Error(Exit::usage) when two parts read one
// role as different types.
Merged merge(std::span<const MergePart> parts);

}  // namespace quell
