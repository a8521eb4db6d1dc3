// What a wire's text names, in the scope where it was written.
#pragma once

#include "core/graph/expand.h"
#include "core/graph/net.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quell {

class Lookup {
 public:
  // The net's nodes have their types; its aliases are made here.
  Lookup(const Expansion&, Net&, const std::vector<Target>& root_inputs, Faults&);

  // `wanted` is the type of the port that reads, for suggestions; 0: any.
  std::optional<Link> link(const WireSpec&, int scope, const std::string& path, int wanted);
  // The alias of a subgraph's input.
  Alias& input_alias(int scope, int input) { return net_.aliases[std::size_t(first_[std::size_t(scope)] + input)]; }
  Alias& output_alias(int scope, int output);
  // Bypassed outputs that something reads, with the alias that stands in for each; to be linked when all ports are.
  const std::map<std::pair<int, int>, int>& bypassed() const { return bypassed_; }

 private:
  std::optional<Target> find(const Reference&, int scope, TextPosition, const std::string& path, int wanted);
  std::optional<Target> in_node(const Reference&, std::size_t at, int node, TextPosition, const std::string& path,
                                int wanted);
  std::optional<Target> in_graph(const Reference&, std::size_t at, int scope, TextPosition, const std::string& path,
                                 int wanted);
  Target stand_in(int node, int output);

  const Expansion& expansion_;
  Net& net_;
  const std::vector<Target>& root_inputs_;
  Faults& faults_;
  std::vector<int> first_;  // alias of each scope's first input; its outputs follow
  std::map<std::pair<int, int>, int> bypassed_;
};

}  // namespace quell
