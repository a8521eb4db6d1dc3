// Node types for tests of graphs: names, ports and parameters of shipped nodes, without their work and without
// libraries.
#pragma once

#include "core/graph/load.h"
#include "core/graph/resolve.h"
#include "core/plugin/registry.h"

#include <string>
#include <string_view>
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

// The graph tests/core/graphs/svgf.json.
std::string svgf_file();
LoadedGraph load_svgf(std::vector<Edit> edits = {});
// The text of a graph with the inputs of svgf, these nodes and these outputs.
std::string graph_with(std::string_view nodes, std::string_view outputs = "\"color\": \"b\"");

const GraphNode& node_called(const Graph&, std::string_view name);
// "name <- port:wire port:wire" a node, in order: what a graph came to be.
std::string shown(const Graph&);
// The line of it that speaks of this node, or the messages when nothing was loaded.
std::string line_of(const LoadedGraph&, const std::string& name);

}  // namespace quell::test
