// A graph cut down to what one of its outputs needs.
#pragma once

#include "core/graph/graph.h"

#include <cstddef>
#include <string>

namespace quell {

// With that output alone, declared as the graph's own under this name, and the nodes and inputs that it needs.
Graph narrowed(const Graph&, std::size_t output, const std::string& name);

}  // namespace quell
