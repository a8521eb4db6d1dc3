// Marks what is reached from the output, then numbers it anew.
#include "core/graph/narrow.h"

#include <utility>
#include <vector>

namespace quell {

Graph narrowed(const Graph& graph, std::size_t output, const std::string& name) {
  std::vector<int> input(graph.inputs.size(), -1), node(graph.nodes.size(), -1);  // new numbers; -1: not needed
  std::vector<std::size_t> pending;
  const auto reach = [&](const Source& s) {
    if (s.node == Source::kInput) input[std::size_t(s.port)] = 0;
    if (s.node >= 0 && std::exchange(node[std::size_t(s.node)], 0) < 0) pending.push_back(std::size_t(s.node));
  };
  const auto reach_wire = [&](const Wire& w) { reach(w.from), reach(w.start); };
  reach_wire(graph.outputs[output].wire);
  while (!pending.empty()) {
    const auto& reached = graph.nodes[pending.back()];
    pending.pop_back();
    for (const auto& port : reached.in)
      for (const auto& wire : port) reach_wire(wire);
  }

  Graph out;
  out.name = graph.name, out.about = graph.about;
  for (std::size_t i = 0; i < input.size(); ++i)
    if (input[i] == 0) input[i] = int(out.inputs.size()), out.inputs.push_back(graph.inputs[i]);
  for (std::size_t n = 0; n < node.size(); ++n)
    if (node[n] == 0) node[n] = int(out.nodes.size()), out.nodes.push_back(graph.nodes[n]);
  const auto renumber = [&](Source& s) {
    if (s.node == Source::kInput) s.port = input[std::size_t(s.port)];
    if (s.node >= 0) s.node = node[std::size_t(s.node)];
  };
  const auto renumber_wire = [&](Wire& w) { renumber(w.from), renumber(w.start); };
  for (auto& kept : out.nodes)
    for (auto& port : kept.in)
      for (auto& wire : port) renumber_wire(wire);
  out.outputs = {graph.outputs[output]};
  out.outputs[0].name = name, out.outputs[0].tap = false;
  renumber_wire(out.outputs[0].wire);
  return out;
}

}  // namespace quell
