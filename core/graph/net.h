// A graph between its stages: node types and ports are known, wires are links between them. Subgraph boundaries and
// bypassed nodes are aliases until `flatten` has followed them.
#pragma once

#include "core/graph/document.h"
#include "core/plugin/node_type.h"

#include <optional>
#include <string>
#include <vector>

namespace quell {

struct Target {
  enum class Kind { none, node, input, alias };
  Kind kind = Kind::none;
  int index = -1;
  int port = 0;  // of a node
  bool operator==(const Target&) const = default;
};

struct Link {
  Target from;
  int delay = 0;
  Target start;
  int as = 0;  // quell_type of a cast, 0: none
  TextPosition position;
};

struct NetPort {
  std::vector<Link> links;
  TextPosition position;  // of the binding; of the node when not written
  bool written = false;
  std::string absent;  // why a written port has no links: "the optional input 'id' is absent"
};

struct NetNode {
  std::string name;  // full
  int scope = 0;
  const NodeSpec* spec = nullptr;
  const NodeType* type = nullptr;
  std::optional<Instance> instance;
  std::vector<NetPort> in;
  std::vector<int> out_types;
};

struct NetInput {
  std::string name;
  int type = 0;
  bool optional = false;
  TextPosition position;
};

struct Alias {
  std::string name;  // "level0.image"
  int type = 0;      // declared for a subgraph's input; 0: none
  bool list = false;
  std::vector<Link> links;
  std::string absent;  // why there are no links
};

struct NetOutput {
  std::string name;
  std::vector<Link> links;  // one, once flat
  TextPosition position;
  std::string absent;
  bool tap = false;
};

// A graph used as a node by the outermost graph.
struct NetUse {
  std::string name;
  TextPosition position;
  bool bypassed = false;
};

struct Net {
  std::vector<NetInput> inputs;
  std::vector<NetNode> nodes;
  std::vector<Alias> aliases;
  std::vector<NetOutput> outputs;
  std::vector<NetUse> uses;
  std::vector<int> use_of_scope;  // which of them a scope lies in; -1: the outermost graph itself

  std::string name_of(const Target&) const;  // "color", "variance.image", "level0.image"
  int type_of(const Target&) const;          // of a node or input, once types are bound; 0: not yet
  int type_of(const Link& l) const { return l.as ? l.as : type_of(l.from); }
  // "level0.atrous.in.weights"
  std::string path(const NetNode& node, std::size_t port) const;
};

}  // namespace quell
