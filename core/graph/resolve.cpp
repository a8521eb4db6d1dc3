// Types and parameters of nodes, links of ports, and what crosses the boundaries of subgraphs.
#include "core/graph/resolve.h"

#include "core/graph/lookup.h"
#include "core/graph/params.h"
#include "core/report/suggest.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace quell {

namespace {

class Resolver {
 public:
  Resolver(Expansion& expansion, Registry& registry, const Library& library, Faults& faults)
      : expansion_(expansion), registry_(registry), library_(library), faults_(faults) {}
  Resolved out;

  void run(std::span<const Tap> taps, const std::optional<Roles>& roles) {
    inputs(roles);
    uses();
    for (const auto& e : expansion_.nodes) node(e);
    Lookup lookup(expansion_, out.net, root_inputs_, faults_);
    for (auto& n : out.net.nodes)
      if (n.type) ports(n, lookup);
    for (std::size_t s = 1; s < expansion_.scopes.size(); ++s) boundary(int(s), lookup);
    outputs(taps, lookup);
    bypass(lookup);
    for (auto& n : out.net.nodes)
      if (n.type && n.spec->swapped && !n.spec->bypass) fill_swapped(out.net, n, roles);
    unused();
  }

 private:
  bool trusted(TextPosition p) const { return p.source >= 0 && faults_.sources().name(p.source).starts_with("--"); }

  void inputs(const std::optional<Roles>& roles) {
    for (const auto& in : expansion_.scopes[0].document->inputs) {
      const std::string path = "inputs." + in.name;
      const bool image = in.type != QUELL_ANY && in.type != QUELL_WEIGHT && !in.list;
      if (!image)
        faults_.error(in.position, path,
                      fmt::format("a sequence cannot provide {}", in.list                ? "a list"
                                                                  : in.type == QUELL_ANY ? "any type"
                                                                                         : "a weight"),
                      {"only a graph that is used as a node may have such an input"});
      if (roles && in.optional && !roles->contains(in.name)) {
        root_inputs_.push_back({Target::Kind::alias, int(out.net.aliases.size()), 0});
        out.net.aliases.push_back({in.name, 0, false, {}, fmt::format("the optional input '{}' is absent", in.name)});
        continue;
      }
      root_inputs_.push_back({Target::Kind::input, int(out.net.inputs.size()), 0});
      out.net.inputs.push_back({in.name, in.type, in.optional, in.position});
    }
  }

  void uses() {
    for (const auto& scope : expansion_.scopes) {
      int use = -1;
      if (scope.parent > 0) use = out.net.use_of_scope[std::size_t(scope.parent)];
      if (scope.parent == 0) {
        use = int(out.net.uses.size());
        out.net.uses.push_back({scope.name, scope.node->position, scope.node->bypass});
      }
      out.net.use_of_scope.push_back(use);
    }
  }

  void node(const ExpandedNode& e) {
    auto& n = out.net.nodes.emplace_back();
    n.name = expansion_.scopes[std::size_t(e.scope)].full(e.spec->name);
    n.scope = e.scope;
    n.spec = e.spec;
    n.type = registry_.find(e.spec->type);
    if (n.type)
      n.instance.emplace(*n.type);
    else
      unknown(n);
    for (const auto& setting : e.spec->set) set(n, setting);
  }

  void unknown(const NetNode& n) {
    const std::string path = n.name + ".type";
    if (const auto* problem = registry_.problem(n.spec->type)) {
      faults_.error(n.spec->type_position, path, fmt::format("the plugin of '{}' cannot be used", n.spec->type),
                    {fmt::format("{}: {}", problem->file.string(), problem->text)}, Exit::plugin);
      return;
    }
    if (type_names_.empty()) type_names_ = registry_.names();
    const auto near = nearest(n.spec->type, type_names_);
    faults_.error(n.spec->type_position, path, fmt::format("there is no node type '{}'", n.spec->type),
                  {near.empty() ? "'quell nodes' lists what there is" : fmt::format("Did you mean '{}'?", near)});
  }

  void set(NetNode& n, const Setting& setting) {
    const std::string path = n.name + ".set." + setting.name;
    const auto value = expansion_.value_of(setting, n.scope, path, faults_);
    if (!value || !n.type) return;
    const int p = n.type->find_param(setting.name);
    if (p < 0) {
      // A swapped node keeps what its new type has a parameter for.
      const bool from_before = n.spec->swapped && setting.scope < 0;
      if (!from_before)
        faults_.error(setting.position, path,
                      fmt::format("node type '{}' has no parameter '{}'", n.type->name(), setting.name),
                      {n.type->params().empty() ? "it has none"
                                                : possibilities("it has", setting.name, names_of(n.type->params()))});
      return;
    }
    auto problem = assign(*n.instance, p, value->json, trusted(value->json.position), library_);
    if (value->root_param >= 0) out.feeds.push_back({value->root_param, n.name, n.type, p});
    if (problem.text.empty()) return;
    if (setting.value.is(Json::Kind::text) && setting.value.text.starts_with("$") &&
        !setting.value.text.starts_with("$$"))
      problem.notes.push_back(fmt::format("it comes through {}", setting.value.text));
    faults_.error(value->json.position, path, problem.text, problem.notes);
  }

  void ports(NetNode& n, Lookup& lookup) {
    n.in.resize(n.type->inputs().size());
    for (auto& port : n.in) port.position = n.spec->position;
    for (const auto& b : n.spec->in) {
      const std::string path = n.name + ".in." + b.port;
      const int p = n.type->find_input(b.port);
      if (p < 0) {
        const bool from_before = n.spec->swapped && (b.wires.empty() || b.wires[0].scope < 0);
        if (!from_before)
          faults_.error(
              b.position, path, fmt::format("node type '{}' has no input '{}'", n.type->name(), b.port),
              {n.type->inputs().empty() ? "it has none" : possibilities("it has", b.port, names_of(n.type->inputs()))});
        continue;
      }
      const auto& port = n.type->inputs()[std::size_t(p)];
      auto& in = n.in[std::size_t(p)];
      in.position = b.position;
      in.written = true;
      in.links = links(b, n.scope, path, port.type, (port.flags & QUELL_LIST) != 0, lookup);
      if (b.wires.empty()) in.absent = "its list is empty";
    }
  }

  std::vector<Link> links(const Binding& b, int scope, const std::string& path, int type, bool list, Lookup& lookup) {
    std::vector<Link> links;
    if (b.list && !list && b.wires.size() != 1) {
      faults_.error(b.wires.empty() ? b.position : b.wires[0].position, path,
                    fmt::format("'{}' takes one wire, not a list of {}", b.port, b.wires.size()));
      return links;
    }
    for (std::size_t i = 0; i < b.wires.size(); ++i) {
      const auto at = b.list ? fmt::format("{}[{}]", path, i) : path;
      const auto link = lookup.link(b.wires[i], scope, at, type);
      if (!link) continue;
      if (!list && link->from.kind == Target::Kind::alias && out.net.aliases[std::size_t(link->from.index)].list)
        faults_.error(link->position, at,
                      fmt::format("'{}' is a list; '{}' takes one wire", join_path(b.wires[i].from.parts), b.port));
      else
        links.push_back(*link);
    }
    return links;
  }

  // A subgraph's inputs read what its user wired to them, its outputs what is inside.
  void boundary(int index, Lookup& lookup) {
    const auto& scope = expansion_.scopes[std::size_t(index)];
    const Document& d = *scope.document;
    for (const auto& b : scope.node->in) {
      const int i = d.find_input(b.port);
      const std::string path = scope.name + ".in." + b.port;
      if (i >= 0) {
        const auto& in = d.inputs[std::size_t(i)];
        lookup.input_alias(index, i).links = links(b, scope.parent, path, in.type, in.list, lookup);
      } else if (!scope.node->swapped) {
        faults_.error(b.position, path, fmt::format("graph '{}' has no input '{}'", scope.node->type, b.port),
                      {d.inputs.empty() ? "it has none" : possibilities("it has", b.port, names_of(d.inputs))});
      }
    }
    for (std::size_t i = 0; i < d.inputs.size(); ++i) {
      const auto& in = d.inputs[i];
      auto& alias = lookup.input_alias(index, int(i));
      const bool written = std::ranges::any_of(scope.node->in, [&](const Binding& b) { return b.port == in.name; });
      if (!written && !in.optional && !in.list)
        faults_.error(scope.node->position, scope.name,
                      fmt::format("input '{}' of graph '{}' is not connected", in.name, scope.node->type),
                      {fmt::format("it takes {}", type_name(in.type))});
      if (alias.links.empty()) alias.absent = fmt::format("the optional input '{}' is absent", alias.name);
    }
    for (std::size_t o = 0; o < d.outputs.size(); ++o) {
      const auto link = lookup.link(d.outputs[o].wire, index, scope.full("outputs." + d.outputs[o].name), 0);
      if (link) lookup.output_alias(index, int(o)).links = {*link};
    }
  }

  void outputs(std::span<const Tap> taps, Lookup& lookup) {
    const Document& d = *expansion_.scopes[0].document;
    for (const auto& o : d.outputs) {
      const auto link = lookup.link(o.wire, 0, "outputs." + o.name, 0);
      if (link) out.net.outputs.push_back({o.name, {*link}, o.position, "", false});
    }
    for (const auto& t : taps) {
      const auto link = lookup.link(t.wire, 0, "", 0);
      const auto same = [&](const NetOutput& o) { return o.name == t.name; };
      if (link && std::ranges::none_of(out.net.outputs, same))
        out.net.outputs.push_back({t.name, {*link}, t.wire.position, "", true});
    }
  }

  // An output of a bypassed node reads what the node's `passes` names; a weight is gone.
  void bypass(const Lookup& lookup) {
    for (const auto& [output, index] : lookup.bypassed()) {
      const auto& n = out.net.nodes[std::size_t(output.first)];
      auto& alias = out.net.aliases[std::size_t(index)];
      const auto& port = n.type->outputs()[std::size_t(output.second)];
      if (n.type->is_weight()) {
        alias.absent = fmt::format("'{}' is bypassed", n.name);
      } else if (port.passes < 0) {
        cannot_bypass(n, port.name);
      } else {
        const auto& in = n.in[std::size_t(port.passes)];
        alias.links = in.links;
        alias.absent = fmt::format("'{}' is bypassed, and its input '{}' is not connected", n.name,
                                   n.type->inputs()[std::size_t(port.passes)].name);
      }
    }
    for (const auto& n : out.net.nodes) {
      const auto passes = [](const quell_port& p) { return p.passes >= 0; };
      if (n.type && n.spec->bypass && !n.type->is_weight() && std::ranges::none_of(n.type->outputs(), passes))
        cannot_bypass(n, n.type->outputs()[0].name);
    }
  }
  void cannot_bypass(const NetNode& n, std::string_view output) {
    std::vector<std::string> passing;
    for (const auto& o : n.type->outputs())
      if (o.passes >= 0)
        passing.push_back(fmt::format("{} (its input {})", o.name, n.type->inputs()[std::size_t(o.passes)].name));
    faults_.error(
        n.spec->bypass_position, n.name + ".bypass",
        fmt::format("output '{}' of '{}' passes nothing, so the node cannot be bypassed", output, n.type->name()),
        {passing.empty() ? "none of its outputs passes an input"
                         : fmt::format("outputs that pass: {}", fmt::join(passing, ", "))});
  }

  void unused() {
    const Document& d = *expansion_.scopes[0].document;
    // A change that sets a node otherwise leaves its parameter without use, and that is meant.
    std::set<std::string_view> written;
    for (const auto& n : d.nodes)
      for (const auto& s : n.set)
        if (s.value.is(Json::Kind::text) && s.value.text.starts_with("$"))
          written.insert(std::string_view(s.value.text).substr(1));
    for (std::size_t i = 0; i < d.params.size(); ++i)
      if (!written.contains(d.params[i].name) && !expansion_.used_params.contains({&d, int(i)}))
        faults_.warning(d.params[i].position, "params." + d.params[i].name,
                        fmt::format("parameter '{}' feeds nothing", d.params[i].name),
                        {fmt::format("a node takes it with \"set\": {{ \"…\": \"${}\" }}", d.params[i].name)});
  }

  Expansion& expansion_;
  Registry& registry_;
  const Library& library_;
  Faults& faults_;
  std::vector<Target> root_inputs_;
  std::vector<std::string> type_names_;
};

}  // namespace

int conventional_role(std::string_view name) {
  static constexpr struct {
    std::string_view role;
    int type;
  } kRoles[] = {{"color", QUELL_RADIANCE},    {"albedo", QUELL_ALBEDO}, {"normal", QUELL_NORMAL},
                {"depth", QUELL_DEPTH},       {"slope", QUELL_SLOPE},   {"position", QUELL_POSITION},
                {"motion", QUELL_MOTION},     {"id", QUELL_ID},         {"emission", QUELL_RADIANCE},
                {"variance", QUELL_VARIANCE}, {"camera", QUELL_CAMERA}, {"transforms", QUELL_TRANSFORMS}};
  for (const auto& r : kRoles)
    if (r.role == name) return r.type;
  return 0;
}

void fill_swapped(Net& net, NetNode& n, const std::optional<Roles>& roles) {
  for (std::size_t p = 0; p < n.in.size(); ++p) {
    const auto& port = n.type->inputs()[p];
    if (!n.in[p].links.empty() || (port.flags & (QUELL_OPTIONAL | QUELL_LIST))) continue;
    const auto fits = [&](int type) { return type == port.type; };
    const auto named = std::ranges::find(net.inputs, std::string_view(port.name), &NetInput::name);
    int input = -1;
    if (named != net.inputs.end()) {
      if (fits(named->type)) input = int(named - net.inputs.begin());
    } else {
      int type = conventional_role(port.name);
      if (roles) type = roles->contains(port.name) ? roles->at(port.name) : 0;
      if (fits(type)) {
        input = int(net.inputs.size());
        net.inputs.push_back({port.name, type, false, n.spec->type_position});
      }
    }
    if (input < 0) continue;
    n.in[p].links.push_back({{Target::Kind::input, input, 0}, 0, {}, 0, n.spec->type_position});
    n.in[p].written = true;
  }
}

std::optional<Resolved> resolve(Expansion& expansion, std::span<const Tap> taps, const std::optional<Roles>& roles,
                                Registry& registry, const Library& library, Faults& faults) {
  Resolver resolver(expansion, registry, library, faults);
  resolver.run(taps, roles);
  if (!faults.ok()) return std::nullopt;
  return std::move(resolver.out);
}

}  // namespace quell
