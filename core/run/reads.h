// What a node reads when it runs: its own wires, and those of the weight nodes that are inlined into it.
#pragma once

#include "core/graph/graph.h"

#include <cstddef>

namespace quell {

// Calls f(wire) for each.
template <class F>
void for_each_read(const Graph& graph, std::size_t node, F&& f) {
  for (const auto& port : graph.nodes[node].in)
    for (const auto& wire : port) {
      const bool weight = wire.from.node >= 0 && graph.nodes[std::size_t(wire.from.node)].type().is_weight();
      if (!weight) {
        f(wire);
        continue;
      }
      for (const auto& inner : graph.nodes[std::size_t(wire.from.node)].in)
        for (const auto& w : inner) f(w);
    }
}

}  // namespace quell
