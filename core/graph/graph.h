// A graph ready to be planned: subgraphs expanded, bypassed and unneeded nodes gone, every port and parameter checked,
// nodes in an order in which each comes after all that it reads undelayed.
#pragma once

#include "core/plugin/node_type.h"
#include "core/report/diagnostics.h"

#include <algorithm>
#include <string>
#include <vector>

namespace quell {

// Where a value comes from: output `port` of node `node`, or graph input `port` when node is kInput.
struct Source {
  static constexpr int kInput = -1;
  static constexpr int kNone = -2;
  int node = kNone;
  int port = 0;
  bool operator==(const Source&) const = default;
};

// A connection. delay = k reads the value of k frames ago; where there is no such past, `start` (undelayed) when it is
// given, else the type's missing value.
struct Wire {
  Source from;
  int delay = 0;
  Source start;
  bool operator==(const Wire&) const = default;
};

struct GraphNode {
  std::string name;  // full: "level0.atrous"
  Instance instance;
  std::vector<std::vector<Wire>> in;  // one an input port; empty: not connected
  std::vector<int> out_types;         // quell_type of each output, type variables bound
  TextPosition position;
  bool preview = false;  // makes a picture of an output: no part of what the graph computes
  const NodeType& type() const { return instance.type(); }
};

struct GraphInput {
  std::string name;  // the role that a sequence provides
  int type;          // quell_type
  bool optional;
};

struct GraphOutput {
  std::string name;
  Wire wire;
  int type;
  bool tap;        // asked for, not declared by the graph
  int shows = -1;  // of a preview: the output that it is a picture of
};

struct Graph {
  std::string name, about;
  std::vector<GraphInput> inputs;  // those that a node or an output reads
  std::vector<GraphNode> nodes;    // in order
  std::vector<GraphOutput> outputs;

  int type_of(Source s) const {
    return s.node == Source::kInput ? inputs[std::size_t(s.port)].type
                                    : nodes[std::size_t(s.node)].out_types[std::size_t(s.port)];
  }
  // Whether anything is read of earlier frames.
  bool looks_back() const {
    const auto delayed = [](const Wire& wire) { return wire.delay > 0; };
    return std::ranges::any_of(outputs, delayed, &GraphOutput::wire) ||
           std::ranges::any_of(nodes, [&](const GraphNode& node) {
             return std::ranges::any_of(node.in, [&](const auto& port) { return std::ranges::any_of(port, delayed); });
           });
  }
};

// Everything that decides a graph's results, as text: nodes, plugin versions, parameters, wires. Equal texts, equal
// results.
std::string fingerprint_text(const Graph&);
// 64-bit FNV-1a of it, as 16 hexadecimal digits.
std::string fingerprint(const Graph&);

}  // namespace quell
