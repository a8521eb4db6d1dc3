// Names become things: node types, parameters, ports and what wires read.
#pragma once

#include "core/graph/expand.h"
#include "core/graph/net.h"
#include "core/graph/variant.h"
#include "core/plugin/registry.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace quell {

// Roles that a sequence provides, with their quell_type.
using Roles = std::map<std::string, int>;

// The type that a role has by convention ("color" is radiance), or 0.
int conventional_role(std::string_view name);

// What a parameter of the outermost graph feeds.
struct ParamFeed {
  int param;         // of the document
  std::string node;  // full name
  const NodeType* type;
  int type_param;
};

struct Resolved {
  Net net;
  std::vector<ParamFeed> feeds;
};

// With `roles`, optional inputs that the sequence lacks are absent.
std::optional<Resolved> resolve(Expansion&, std::span<const Tap>, const std::optional<Roles>&, Registry&,
                                const Library&, Faults&);

// The required inputs of a swapped node that nothing is wired to: each takes the graph's input of its name and type, or
// else the role that a sequence has by that name.
void fill_swapped(Net&, NetNode&, const std::optional<Roles>&);

}  // namespace quell
