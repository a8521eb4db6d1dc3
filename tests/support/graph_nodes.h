// Node types for tests of graphs: names, ports and parameters of shipped nodes, without their work and without
// libraries.
#pragma once

#include "core/graph/load.h"
#include "core/graph/resolve.h"
#include "core/plugin/registry.h"

#include <string>
#include <vector>

namespace quell::test {

// A registry of these types alone.
Registry& graph_registry();

// What loading a graph gave.
struct LoadedGraph {
  std::optional<Graph> graph;
  std::string messages;  // all errors and warnings as they are printed
  GraphInfo info;
};
LoadedGraph load(GraphRequest);
// A graph given as text, called "t.json".
LoadedGraph load_text(std::string text, std::vector<Edit> edits = {});

// "name <- port:wire port:wire" a node, in order: what a graph came to be.
std::string shown(const Graph&);

}  // namespace quell::test
