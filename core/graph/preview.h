// Pictures of a graph's outputs, made by nodes as everything else is.
#pragma once

#include "core/graph/graph.h"

namespace quell {

// Appends `shown` to the graph: its one input, `image`, reads what output `output` reads, and its first output, of type
// display, becomes an output that shows that one. It changes neither other outputs nor the graph's fingerprint. Throws
// Error(Exit::usage) when `shown` reads anything else, gives no display or keeps history.
void add_preview(Graph& graph, int output, Graph shown);

}  // namespace quell
