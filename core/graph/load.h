// From a graph's name or file to a graph that is ready to be planned.
#pragma once

#include "core/graph/graph.h"
#include "core/graph/metric_key.h"
#include "core/graph/variant.h"
#include "core/plugin/registry.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace quell {

struct GraphRequest {
  std::string graph;              // a path, or an installed graph when it has neither a slash nor ".json"
  std::filesystem::path graphs;   // folder of installed graphs
  std::vector<Edit> edits;        // from the command line
  std::optional<Json> laid_over;  // one more variant over the graph, without a "base": what a study tries
  std::optional<std::map<std::string, int>> roles;  // what the sequence provides; without, all inputs are present
  std::optional<std::string> text;                  // in place of the file's content
};

// A parameter of the graph, as it inherits from what it feeds.
struct GraphParam {
  std::string name;
  std::string value;               // as JSON text
  std::vector<std::string> feeds;  // "level0.atrous.step"
  std::string takes, doc;          // of the first that it feeds; "" when it feeds nothing
};

// What a graph says of itself.
struct GraphInfo {
  std::string file, name, about;
  std::optional<MetricKey> metric;
  std::vector<GraphInput> inputs;  // all that are declared
  std::vector<GraphParam> params;
  std::vector<std::string> outputs;
};

// Runs all stages. All errors of a stage are reported together; the first stage that has some is the last. `info` is
// filled as far as that goes.
std::optional<Graph> load_graph(const GraphRequest&, Registry&, Diagnostics&, GraphInfo* info = nullptr);

// Names of installed graphs.
std::vector<std::string> installed_graphs(const std::filesystem::path& graphs);

}  // namespace quell
