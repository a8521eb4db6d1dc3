// Follows dotted names through scopes.
#include "core/graph/lookup.h"

#include "core/report/suggest.h"

#include <quell/types.h>

#include <fmt/format.h>

namespace quell {

namespace {

std::string written(const Reference& r, std::size_t parts) {
  return join_path({r.parts.begin(), r.parts.begin() + std::ptrdiff_t(parts)});
}

}  // namespace

Lookup::Lookup(const Expansion& expansion, Net& net, const std::vector<Target>& root_inputs, Faults& faults)
    : expansion_(expansion), net_(net), root_inputs_(root_inputs), faults_(faults) {
  for (const auto& scope : expansion.scopes) {
    first_.push_back(int(net.aliases.size()));
    if (scope.parent < 0) continue;
    for (const auto& in : scope.document->inputs)
      net.aliases.push_back({scope.full(in.name), in.type == QUELL_ANY ? 0 : in.type, in.list, {}, ""});
    for (const auto& out : scope.document->outputs) net.aliases.push_back({scope.full(out.name), 0, false, {}, ""});
  }
}

Alias& Lookup::output_alias(int scope, int output) {
  const auto inputs = expansion_.scopes[std::size_t(scope)].document->inputs.size();
  return net_.aliases[std::size_t(first_[std::size_t(scope)]) + inputs + std::size_t(output)];
}

std::optional<Link> Lookup::link(const WireSpec& wire, int scope, const std::string& path, int wanted) {
  if (wire.scope >= 0) scope = wire.scope;
  Link link;
  link.delay = wire.from.delay;
  link.as = wire.as;
  link.position = wire.position;
  const auto from = find(wire.from, scope, wire.position, path, wire.as ? wire.as : wanted);
  if (from) link.from = *from;
  if (wire.start) {
    const auto start = find(*wire.start, scope, wire.start_position, path + ".start", wanted);
    if (!start) return std::nullopt;
    link.start = *start;
  }
  return from ? std::optional(link) : std::nullopt;
}

std::optional<Target> Lookup::find(const Reference& r, int scope, TextPosition position, const std::string& path,
                                   int wanted) {
  const auto& s = expansion_.scopes[std::size_t(scope)];
  const Document& d = *s.document;
  if (const int i = d.find_input(r.parts[0]); i >= 0) {
    if (r.parts.size() > 1) {
      faults_.error(position, path, fmt::format("'{}' is an input of the graph and has no ports", r.parts[0]),
                    {fmt::format("write '{}'", r.parts[0])});
      return std::nullopt;
    }
    if (s.parent < 0) return root_inputs_[std::size_t(i)];
    return Target{Target::Kind::alias, first_[std::size_t(scope)] + i, 0};
  }
  const auto [n, parts] = d.find_node(std::span(r.parts));
  if (n < 0) {
    if (faults_.full()) return std::nullopt;
    auto names = names_of(d.nodes);
    const auto inputs = names_of(d.inputs);
    const auto all = [&] {
      auto both = names;
      both.insert(both.end(), inputs.begin(), inputs.end());
      return both;
    }();
    const auto near = nearest(r.parts[0], all);
    faults_.error(position, path, fmt::format("there is no node or input '{}'", r.parts[0]),
                  {possibilities("nodes", "", names), possibilities("inputs", "", inputs),
                   near.empty() ? "" : fmt::format("Did you mean '{}'?", near)});
    return std::nullopt;
  }
  const auto& place = s.places[std::size_t(n)];
  return place.graph ? in_graph(r, parts, place.index, position, path, wanted)
                     : in_node(r, parts, place.index, position, path, wanted);
}

std::optional<Target> Lookup::in_node(const Reference& r, std::size_t at, int node, TextPosition position,
                                      const std::string& path, int wanted) {
  const auto& n = net_.nodes[std::size_t(node)];
  if (!n.type) return std::nullopt;  // its type is unknown, which has been said
  const auto outputs = n.type->outputs();
  const std::string name = written(r, at);
  int output = 0;
  if (r.parts.size() == at) {
    if (outputs.size() == 1) return stand_in(node, 0);
    faults_.error(position, path, fmt::format("node '{}' has {} outputs; name one", name, outputs.size()),
                  {possibilities("it has", "", names_of(outputs))});
    return std::nullopt;
  }
  output = n.type->find_output(r.parts[at]);
  if (output >= 0 && r.parts.size() == at + 1) return stand_in(node, output);
  if (output >= 0) {
    faults_.error(position, path, fmt::format("'{}' is an output and has no parts", written(r, at + 1)));
    return std::nullopt;
  }
  const auto names = names_of(outputs);
  std::string note = possibilities("it has", r.parts[at], names);
  if (nearest(r.parts[at], names).empty()) {
    std::string fits;
    for (const auto& o : outputs)
      if (o.type == wanted) fits = fits.empty() ? o.name : "?";
    if (!fits.empty() && fits != "?") note += fmt::format(". Did you mean '{}'?", fits);
  }
  faults_.error(position, path, fmt::format("node '{}' has no output '{}'", name, r.parts[at]), {note});
  return std::nullopt;
}

std::optional<Target> Lookup::in_graph(const Reference& r, std::size_t at, int scope, TextPosition position,
                                       const std::string& path, int wanted) {
  const auto& s = expansion_.scopes[std::size_t(scope)];
  const Document& d = *s.document;
  int output = -1;
  if (r.parts.size() == at) {
    if (d.outputs.size() != 1) {
      faults_.error(position, path,
                    fmt::format("graph node '{}' has {} outputs; name one", written(r, at), d.outputs.size()),
                    {possibilities("it has", "", names_of(d.outputs))});
      return std::nullopt;
    }
    output = 0;
  } else if (r.parts.size() == at + 1) {
    output = d.find_output(r.parts[at]);
  }
  if (output >= 0) {
    if (s.node->bypass) {
      const auto& name = d.outputs[std::size_t(output)].name;
      if (const int i = d.find_input(name); i >= 0)
        return Target{Target::Kind::alias, first_[std::size_t(scope)] + i, 0};
      faults_.error(
          s.node->bypass_position, s.name + ".bypass",
          fmt::format("output '{}' of graph '{}' passes nothing, so the node cannot be bypassed", name, s.node->type),
          {"an output of a graph passes the input of its name"});
      return std::nullopt;
    }
    return Target{Target::Kind::alias, first_[std::size_t(scope)] + int(d.inputs.size()) + output, 0};
  }
  if (const auto [n, parts] = d.find_node(std::span(r.parts).subspan(at)); n >= 0) {
    const auto& place = s.places[std::size_t(n)];
    return place.graph ? in_graph(r, at + parts, place.index, position, path, wanted)
                       : in_node(r, at + parts, place.index, position, path, wanted);
  }
  faults_.error(position, path, fmt::format("graph node '{}' has no output '{}'", written(r, at), r.parts[at]),
                {possibilities("it has", r.parts[at], names_of(d.outputs))});
  return std::nullopt;
}

Target Lookup::stand_in(int node, int output) {
  const auto& n = net_.nodes[std::size_t(node)];
  if (!n.spec->bypass) return {Target::Kind::node, node, output};
  auto [it, fresh] = bypassed_.emplace(std::pair(node, output), int(net_.aliases.size()));
  if (fresh) net_.aliases.push_back({n.name + "." + n.type->outputs()[std::size_t(output)].name, 0, false, {}, ""});
  return {Target::Kind::alias, it->second, 0};
}

}  // namespace quell
