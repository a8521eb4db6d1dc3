// A resolved graph as a graph file: the inverse of load.
#pragma once

#include "core/graph/graph.h"
#include "core/graph/metric_key.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace quell {

struct WrittenGraph {
  // A graph file that stands for itself: no subgraphs, no base, no parameters of its own, no taps and previews; every
  // parameter of each node spelt out, and nodes of subgraphs under their full names ("level0.atrous"). Loading it gives
  // a graph of the same fingerprint.
  std::string text;
  // What no graph file may say, for it names files: values of --set, "node.parameter=/folder/file".
  std::vector<std::string> files;
};

// `graphs` is the folder of installed graphs, whose files are written as "quell:…". `metric` is the key of a graph that
// is one.
WrittenGraph write_graph(const Graph&, const std::filesystem::path& graphs,
                         const std::optional<MetricKey>& metric = std::nullopt);

// What a wire reads, as --tap and graph files name it: "level0.atrous.image@-1". Its start is not said.
std::string reference_text(const Graph&, const Wire&);

}  // namespace quell
