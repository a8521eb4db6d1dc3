// Subgraphs opened up: every use of a graph has its own scope of names, and all nodes stand in one list.
#pragma once

#include "core/graph/library.h"

#include <deque>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace quell {

inline constexpr std::size_t kMaxNodes = 100'000;
inline constexpr std::size_t kMaxGraphDepth = 32;

// Where a node of a document came to stand.
struct Place {
  bool graph = false;  // `index` is a scope, else a node
  int index = -1;
};

// A parameter's value with every "$name" replaced, and the parameter of the outermost graph that gave it.
struct ParamValue {
  Json json;
  int root_param = -1;
};

// One use of a document.
struct Scope {
  const Document* document = nullptr;
  std::string name;  // "level0"; "" for the outermost
  int parent = -1;
  const NodeSpec* node = nullptr;  // in the parent
  std::vector<Place> places;       // one a node of the document
  std::vector<ParamValue> params;  // one a parameter of the document

  std::string full(const std::string& inner) const { return name.empty() ? inner : name + "." + inner; }
};

struct ExpandedNode {
  const NodeSpec* spec;
  int scope;
};

struct Expansion {
  std::vector<Scope> scopes;  // the outermost first
  std::vector<ExpandedNode> nodes;
  std::deque<NodeSpec> edited;  // nodes that a change has touched
  std::set<std::pair<const Document*, int>> used_params;

  // "$name" replaced by what it stands for where `setting` was written; "$$" by a dollar.
  std::optional<ParamValue> value_of(const Setting& setting, int scope, const std::string& path, Faults&);
};

std::optional<Expansion> expand(const Document& root, std::span<const Change> changes, Library&, Faults&);

}  // namespace quell
