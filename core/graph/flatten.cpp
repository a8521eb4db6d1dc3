// Aliases are followed depth first with a stack of their own: a chain of them may be as long as a graph has nodes.
#include "core/graph/flatten.h"

#include "core/graph/reference.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

constexpr std::size_t kMaxWires = 1024;  // in one list

class Flattener {
 public:
  Flattener(Net& net, Faults& faults) : net_(net), faults_(faults), state_(net.aliases.size(), State::untouched) {}

  void aliases() {
    for (std::size_t i = 0; i < net_.aliases.size(); ++i)
      if (state_[i] == State::untouched) follow(int(i));
  }

  // Replaces links to aliases, which are flat, by what those hold. `absent` is why nothing is left.
  void links(std::vector<Link>& list, std::string& absent, const std::string& path) {
    const bool needed = std::ranges::any_of(
        list, [](const Link& l) { return l.from.kind == Target::Kind::alias || l.start.kind == Target::Kind::alias; });
    if (!needed) return;
    std::vector<Link> flat;
    for (auto link : list) {
      settle_start(link, path);
      if (link.from.kind != Target::Kind::alias) {
        flat.push_back(link);
        continue;
      }
      const auto& alias = net_.aliases[std::size_t(link.from.index)];
      if (alias.links.empty() && flat.empty()) absent = alias.absent;
      for (const auto& inner : alias.links) flat.push_back(compose(link, inner, path));
      if (flat.size() > kMaxWires) {
        faults_.error(link.position, path, fmt::format("more than {} wires in one list", kMaxWires));
        flat.clear();
        break;
      }
    }
    list = std::move(flat);
  }

 private:
  enum class State : char { untouched, open, done };

  // Aliases that links of this alias name and that are not yet flat.
  int next_open(int alias, std::size_t& at) {
    const auto& links = net_.aliases[std::size_t(alias)].links;
    for (; at < 2 * links.size(); ++at) {
      const Link& link = links[at / 2];
      const Target& t = at % 2 == 0 ? link.from : link.start;
      if (t.kind == Target::Kind::alias && state_[std::size_t(t.index)] != State::done) return t.index;
    }
    return -1;
  }

  void follow(int first) {
    std::vector<std::pair<int, std::size_t>> stack{{first, 0}};
    state_[std::size_t(first)] = State::open;
    while (!stack.empty()) {
      auto& [alias, at] = stack.back();
      const int next = next_open(alias, at);
      if (next >= 0 && state_[std::size_t(next)] == State::open) {
        circular(stack, next);
        net_.aliases[std::size_t(alias)].links.clear();
      } else if (next >= 0) {
        state_[std::size_t(next)] = State::open;
        stack.emplace_back(next, 0);
      } else {
        auto& a = net_.aliases[std::size_t(alias)];
        links(a.links, a.absent, a.name);
        state_[std::size_t(alias)] = State::done;
        stack.pop_back();
      }
    }
  }

  void circular(const std::vector<std::pair<int, std::size_t>>& stack, int again) {
    std::vector<std::string> names;
    for (const auto& [alias, at] : stack)
      if (alias == again || !names.empty()) names.push_back(net_.aliases[std::size_t(alias)].name);
    names.push_back(names.front());
    const auto& a = net_.aliases[std::size_t(stack.back().first)];
    faults_.error(a.links[stack.back().second / 2].position, a.name,
                  fmt::format("'{}' reads nothing but itself", a.name), {fmt::format("{}", fmt::join(names, " ← "))});
  }

  // A start is one undelayed value.
  void settle_start(Link& link, const std::string& path) {
    if (link.start.kind != Target::Kind::alias) return;
    const auto& alias = net_.aliases[std::size_t(link.start.index)];
    if (alias.links.size() > 1 || (alias.links.size() == 1 && alias.links[0].delay > 0))
      faults_.error(link.position, path, fmt::format("the start '{}' must be one undelayed wire", alias.name));
    link.start = alias.links.empty() ? Target{} : alias.links[0].from;
  }

  // What `outer` reads, given that what it names reads `inner`.
  Link compose(const Link& outer, const Link& inner, const std::string& path) {
    Link link = inner;
    link.position = outer.position;
    link.delay += outer.delay;
    if (outer.as) link.as = outer.as;
    const bool outer_start = outer.start.kind != Target::Kind::none,
               inner_start = inner.start.kind != Target::Kind::none;
    if (link.delay > kMaxDelay)
      faults_.error(outer.position, path,
                    fmt::format("delays add up to {} frames; {} are the most", link.delay, kMaxDelay));
    // A start holds for the frames of one delay; of two it would have to hold for a part only.
    if ((outer_start && inner.delay > 0) || (inner_start && outer.delay > 0))
      faults_.error(outer.position, path, "a wire with a start cannot be delayed twice",
                    {fmt::format("'{}' is delayed already", net_.aliases[std::size_t(outer.from.index)].name)});
    if (outer_start) link.start = outer.start;
    return link;
  }

  Net& net_;
  Faults& faults_;
  std::vector<State> state_;
};

}  // namespace

void flatten(Net& net, Faults& faults) {
  Flattener flattener(net, faults);
  flattener.aliases();
  for (auto& n : net.nodes)
    for (std::size_t p = 0; p < n.in.size(); ++p) flattener.links(n.in[p].links, n.in[p].absent, net.path(n, p));
  for (auto& o : net.outputs) flattener.links(o.links, o.absent, o.tap ? "" : "outputs." + o.name);
}

void drop_absent(Net& net) {
  std::vector<std::vector<std::pair<int, int>>> readers(net.nodes.size());  // node, port; port -1: output `node`
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    for (std::size_t p = 0; p < net.nodes[n].in.size(); ++p)
      for (const auto& l : net.nodes[n].in[p].links)
        if (l.from.kind == Target::Kind::node) readers[std::size_t(l.from.index)].emplace_back(int(n), int(p));
  for (std::size_t o = 0; o < net.outputs.size(); ++o)
    for (const auto& l : net.outputs[o].links)
      if (l.from.kind == Target::Kind::node) readers[std::size_t(l.from.index)].emplace_back(int(o), -1);

  std::vector<std::pair<int, int>> empty;  // input ports that have no links
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    for (std::size_t p = 0; p < net.nodes[n].in.size(); ++p)
      if (net.nodes[n].in[p].links.empty()) empty.emplace_back(int(n), int(p));
  while (!empty.empty()) {
    const auto [index, port] = empty.back();
    empty.pop_back();
    const auto& node = net.nodes[std::size_t(index)];
    for (std::size_t o = 0; o < node.type->outputs().size(); ++o) {
      if (node.type->outputs()[o].with != port) continue;
      const Target gone{Target::Kind::node, index, int(o)};
      const auto reason = fmt::format("output '{}' exists only when input '{}' is connected", net.name_of(gone),
                                      node.name + "." + node.type->inputs()[std::size_t(port)].name);
      const auto drop = [&](std::vector<Link>& links, std::string& absent) {
        for (auto& l : links)
          if (l.start == gone) l.start = {};
        if (std::erase_if(links, [&](const Link& l) { return l.from == gone; }) == 0) return false;
        if (links.empty()) absent = reason;
        return links.empty();
      };
      for (const auto& [reader, p] : readers[std::size_t(index)]) {
        if (p < 0) {
          auto& output = net.outputs[std::size_t(reader)];
          drop(output.links, output.absent);
        } else if (auto& in = net.nodes[std::size_t(reader)].in[std::size_t(p)]; drop(in.links, in.absent)) {
          empty.emplace_back(reader, p);
        }
      }
    }
  }
}

}  // namespace quell
