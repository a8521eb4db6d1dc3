// What people read about a graph, from what it says of itself.
#pragma once

#include "core/graph/graph.h"
#include "core/graph/load.h"

#include <string>

namespace quell {

// A section of the graph reference, headed "## NAME" by the name that the command line knows it by: what it is, its
// picture, the inputs that it takes, its parameters and what each feeds, its outputs, the node types in it.
std::string guide_markdown(const GraphInfo&, const Graph&);

}  // namespace quell
