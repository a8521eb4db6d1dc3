// Depth-first walks with stacks of their own: a chain of 100,000 nodes is a graph like any other.
#include "core/graph/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace quell {

namespace {

template <class Use>
void each_link(const NetNode& n, Use use) {
  for (const auto& port : n.in)
    for (const auto& link : port.links) use(link);
}

// Nodes that must come before: read undelayed, as a start too.
std::vector<std::pair<int, TextPosition>> before(const NetNode& n) {
  std::vector<std::pair<int, TextPosition>> nodes;
  each_link(n, [&](const Link& l) {
    if (l.delay == 0 && l.from.kind == Target::Kind::node) nodes.emplace_back(l.from.index, l.position);
    if (l.start.kind == Target::Kind::node) nodes.emplace_back(l.start.index, l.position);
  });
  return nodes;
}

}  // namespace

std::vector<bool> needed(const Net& net, Faults& faults) {
  std::vector<bool> kept(net.nodes.size(), false);
  std::vector<int> open;
  const auto reach = [&](const Link& l) {
    for (const auto& t : {l.from, l.start})
      if (t.kind == Target::Kind::node && !kept[std::size_t(t.index)])
        kept[std::size_t(t.index)] = true, open.push_back(t.index);
  };
  for (const auto& o : net.outputs)
    for (const auto& l : o.links) reach(l);
  while (!open.empty()) {
    const int n = open.back();
    open.pop_back();
    each_link(net.nodes[std::size_t(n)], reach);
  }
  // Within a subgraph a node may well be of use elsewhere: only what the graph itself names is worth a word.
  std::vector<bool> used(net.uses.size(), false);
  for (std::size_t i = 0; i < net.nodes.size(); ++i) {
    const auto& n = net.nodes[i];
    const int use = net.use_of_scope[std::size_t(n.scope)];
    if (use >= 0)
      used[std::size_t(use)] = used[std::size_t(use)] || kept[i];
    else if (!kept[i] && !n.spec->bypass)
      faults.warning(n.spec->position, n.name, fmt::format("no output needs node '{}'; it is left out", n.name));
  }
  for (std::size_t u = 0; u < used.size(); ++u)
    if (const auto& use = net.uses[u]; !used[u] && !use.bypassed)
      faults.warning(use.position, use.name, fmt::format("no output needs node '{}'; it is left out", use.name));
  return kept;
}

std::vector<int> order(const Net& net, const std::vector<bool>& kept, Faults& faults) {
  enum class State : char { untouched, open, done };
  struct Visit {
    int node;
    std::vector<std::pair<int, TextPosition>> before;
    std::size_t at = 0;
  };
  std::vector<State> state(net.nodes.size(), State::untouched);
  std::vector<int> order;
  std::vector<Visit> stack;
  const auto enter = [&](int n) {
    state[std::size_t(n)] = State::open;
    stack.push_back({n, before(net.nodes[std::size_t(n)])});
  };
  for (std::size_t first = 0; first < net.nodes.size(); ++first) {
    if (!kept[first] || state[first] != State::untouched) continue;
    enter(int(first));
    while (!stack.empty()) {
      auto& visit = stack.back();
      if (visit.at == visit.before.size()) {
        state[std::size_t(visit.node)] = State::done;
        order.push_back(visit.node);
        stack.pop_back();
        continue;
      }
      const auto [next, position] = visit.before[visit.at++];
      if (state[std::size_t(next)] == State::untouched) {
        enter(next);
      } else if (state[std::size_t(next)] == State::open) {
        std::vector<std::string> names{net.nodes[std::size_t(next)].name};
        for (auto v = stack.rbegin(); v->node != next; ++v)
          names.insert(names.begin() + 1, net.nodes[std::size_t(v->node)].name);
        const std::size_t length = names.size();
        if (length > 12) names.erase(names.begin() + 11, names.end() - 1), names[11 - 1] = "…";
        names.push_back(names.front());
        // Data flows along the arrows: each reads the one before it.
        std::ranges::reverse(names);
        faults.error(position, net.nodes[std::size_t(visit.node)].name,
                     fmt::format("a cycle of {} {} without a delay", length, length == 1 ? "node" : "nodes"),
                     {fmt::format("{}", fmt::join(names, " → ")),
                      "one of these wires must read an earlier frame: node.port@-1"});
      }
    }
  }
  return order;
}

Graph assemble(Net&& net, const std::vector<int>& order) {
  Graph graph;
  std::vector<int> place(net.nodes.size(), -1), input_place(net.inputs.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) place[std::size_t(order[i])] = int(i);

  std::vector<bool> read(net.inputs.size(), false);
  const auto mark = [&](const Link& l) {
    for (const auto& t : {l.from, l.start})
      if (t.kind == Target::Kind::input) read[std::size_t(t.index)] = true;
  };
  for (const int n : order) each_link(net.nodes[std::size_t(n)], mark);
  for (const auto& o : net.outputs) mark(o.links[0]);
  for (std::size_t i = 0; i < net.inputs.size(); ++i) {
    if (!read[i]) continue;
    input_place[i] = int(graph.inputs.size());
    graph.inputs.push_back({net.inputs[i].name, net.inputs[i].type, net.inputs[i].optional});
  }

  const auto source = [&](const Target& t) -> Source {
    if (t.kind == Target::Kind::node) return {place[std::size_t(t.index)], t.port};
    if (t.kind == Target::Kind::input) return {Source::kInput, input_place[std::size_t(t.index)]};
    return {};
  };
  const auto wire = [&](const Link& l) { return Wire{source(l.from), l.delay, source(l.start)}; };
  for (const auto& o : net.outputs) graph.outputs.push_back({o.name, wire(o.links[0]), net.type_of(o.links[0]), o.tap});
  graph.nodes.reserve(order.size());
  for (const int n : order) {
    auto& from = net.nodes[std::size_t(n)];
    GraphNode node{std::move(from.name), std::move(*from.instance), {}, std::move(from.out_types), from.spec->position};
    for (const auto& port : from.in) {
      auto& wires = node.in.emplace_back();
      for (const auto& l : port.links) wires.push_back(wire(l));
    }
    graph.nodes.push_back(std::move(node));
  }
  return graph;
}

}  // namespace quell
