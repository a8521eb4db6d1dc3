// Opens subgraphs depth first, applying the changes that are addressed to each scope on the way down.
#include "core/graph/expand.h"

#include "core/report/suggest.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

// A change on its way to the scope that it is addressed to.
struct Addressed {
  const Change* change;
  std::size_t depth;  // parts of the target that led here
  int scope;          // where its own names are looked up
};

class Expander {
 public:
  Expander(Library& library, Faults& faults) : library_(library), faults_(faults) {}
  Expansion out;

  void open(int index, std::vector<Addressed> changes) {
    const Document& document = *out.scopes[std::size_t(index)].document;
    std::vector<Addressed> all;
    for (const auto& c : document.changes) all.push_back({&c, 0, index});
    all.insert(all.end(), changes.begin(), changes.end());

    std::vector<const NodeSpec*> specs;
    for (const auto& n : document.nodes) specs.push_back(&n);
    std::unordered_map<int, std::vector<Addressed>> inner;
    for (const auto& a : all) apply(index, a, specs, inner);

    for (std::size_t i = 0; i < specs.size() && !full(); ++i) {
      auto& scope = out.scopes[std::size_t(index)];
      if (!specs[i]->graph) {
        scope.places[i] = {false, int(out.nodes.size())};
        out.nodes.push_back({specs[i], index});
      } else if (const int child = enter(index, *specs[i]); child >= 0) {
        out.scopes[std::size_t(index)].places[i] = {true, child};
        open(child, std::move(inner[int(i)]));
      }
    }
  }

  void root(const Document& document) {
    Scope scope;
    scope.document = &document;
    scope.places.resize(document.nodes.size());
    for (std::size_t i = 0; i < document.params.size(); ++i) {
      scope.params.push_back({document.params[i].value, int(i)});
      unescape(scope.params.back().json);
    }
    out.scopes.push_back(std::move(scope));
  }

 private:
  static void unescape(Json& json) {
    if (json.is(Json::Kind::text) && json.text.starts_with("$$")) json.text.erase(0, 1);
  }
  bool full() {
    if (out.nodes.size() + out.scopes.size() <= kMaxNodes) return false;
    faults_.error(out.scopes[0].document->position, "", fmt::format("more than {} nodes", kMaxNodes));
    return true;
  }

  // A scope for `node`, which is a graph; -1 when it cannot be opened.
  int enter(int parent, const NodeSpec& node) {
    const std::string name = out.scopes[std::size_t(parent)].full(node.name);
    const Document* document = library_.open(node.type, node.type_position, name + ".graph");
    if (!document) return -1;
    std::vector<std::string> files{document->file};
    bool again = false;
    for (int s = parent; s >= 0; s = out.scopes[std::size_t(s)].parent) {
      files.push_back(out.scopes[std::size_t(s)].document->file);
      again |= files.back() == document->file;
    }
    std::ranges::reverse(files);
    if (again || files.size() > kMaxGraphDepth) {
      faults_.error(node.type_position, name + ".graph",
                    again ? "a graph cannot contain itself" : fmt::format("graphs nest deeper than {}", kMaxGraphDepth),
                    {fmt::format("{}", fmt::join(files, " → "))});
      return -1;
    }
    Scope scope;
    scope.document = document;
    scope.name = name;
    scope.parent = parent;
    scope.node = &node;
    scope.places.resize(document->nodes.size());
    for (const auto& p : document->params) {
      scope.params.push_back({p.value, -1});
      unescape(scope.params.back().json);
    }
    for (const auto& s : node.set) {
      const int p = document->find_param(s.name);
      const std::string path = name + ".set." + s.name;
      if (p < 0) {
        if (node.swapped && s.scope < 0) continue;
        faults_.error(s.position, path, fmt::format("graph '{}' has no parameter '{}'", node.type, s.name),
                      {possibilities("it has", s.name, names_of(document->params))});
      } else if (auto value = out.value_of(s, parent, path, faults_)) {
        scope.params[std::size_t(p)] = std::move(*value);
      }
    }
    out.scopes.push_back(std::move(scope));
    return int(out.scopes.size()) - 1;
  }

  NodeSpec& edit(const NodeSpec*& spec) {
    spec = &out.edited.emplace_back(*spec);
    return out.edited.back();
  }

  void apply(int index, const Addressed& a, std::vector<const NodeSpec*>& specs,
             std::unordered_map<int, std::vector<Addressed>>& inner) {
    const Change& c = *a.change;
    auto& scope = out.scopes[std::size_t(index)];
    const std::string path = c.position.source >= 0 && faults_.sources().name(c.position.source).starts_with("--")
                                 ? ""
                                 : fmt::format("{}", join_path(c.target));
    const auto rest = std::span(c.target).subspan(a.depth);
    if (c.kind == Change::Kind::set && rest.size() == 1) return set_param(index, a, path);
    const std::size_t behind = c.kind == Change::Kind::set || c.kind == Change::Kind::wire ? 1 : 0;  // parameter, port
    const auto [n, parts] = scope.document->find_node(rest.first(rest.size() - behind));
    if (n < 0) {
      const bool input = scope.document->find_input(rest[0]) >= 0;
      faults_.error(c.position, path,
                    input ? fmt::format("'{}' is an input, not a node", rest[0])
                          : fmt::format("there is no node '{}'", scope.full(rest[0])),
                    {possibilities("nodes", rest[0], names_of(scope.document->nodes))});
      return;
    }
    auto& spec = specs[std::size_t(n)];
    if (rest.size() != parts + behind) {
      if (spec->graph)
        inner[n].push_back({a.change, a.depth + parts, a.scope});
      else
        faults_.error(c.position, path,
                      fmt::format("node '{}' is no graph; it has no node '{}'", scope.full(spec->name), rest[parts]));
      return;
    }
    NodeSpec& node = edit(spec);
    switch (c.kind) {
      case Change::Kind::swap:
        node.graph = c.type.ends_with(".json");
        node.type = c.type;
        node.type_position = c.value_position;
        node.swapped = true;
        break;
      case Change::Kind::bypass:
        node.bypass = true;
        node.bypass_position = c.value_position;
        break;
      case Change::Kind::wire:
        rewire(node, a, path);
        break;
      case Change::Kind::set:
        reset(node, a, path);
        break;
    }
  }

  void set_param(int index, const Addressed& a, const std::string& path) {
    const Change& c = *a.change;
    auto& scope = out.scopes[std::size_t(index)];
    const auto& name = c.target[a.depth];
    const int p = scope.document->find_param(name);
    if (p < 0) {
      const bool node = scope.document->find_node(name) >= 0;
      faults_.error(c.position, path, fmt::format("the graph has no parameter '{}'", name),
                    {possibilities("it has", name, names_of(scope.document->params)),
                     node ? fmt::format("'{}' is a node; its parameters are set as {}.parameter", name, name) : ""});
    } else if (auto value = out.value_of({name, c.position, c.value, -1}, a.scope, path, faults_)) {
      scope.params[std::size_t(p)].json = std::move(value->json);
    }
  }
  void rewire(NodeSpec& node, const Addressed& a, const std::string& path) {
    Binding binding = a.change->binding;
    for (auto& w : binding.wires) w.scope = a.scope;
    const auto it = std::ranges::find(node.in, binding.port, &Binding::port);
    const bool remove = binding.wires.empty() && binding.list;
    if (it == node.in.end() && remove)
      faults_.error(a.change->position, path, fmt::format("input '{}' is not connected", binding.port));
    else if (it == node.in.end())
      node.in.push_back(std::move(binding));
    else if (remove)
      node.in.erase(it);
    else
      *it = std::move(binding);
  }
  void reset(NodeSpec& node, const Addressed& a, const std::string& path) {
    const Change& c = *a.change;
    const auto it = std::ranges::find(node.set, c.target.back(), &Setting::name);
    Setting setting{c.target.back(), c.position, c.value, a.scope};
    if (it == node.set.end() && c.value.is(Json::Kind::null))
      faults_.error(c.position, path,
                    fmt::format("parameter '{}' is not set; null has nothing to remove", setting.name));
    else if (it == node.set.end())
      node.set.push_back(std::move(setting));
    else if (c.value.is(Json::Kind::null))
      node.set.erase(it);
    else
      *it = std::move(setting);
  }

  Library& library_;
  Faults& faults_;
};

}  // namespace

std::optional<ParamValue> Expansion::value_of(const Setting& setting, int scope, const std::string& path,
                                              Faults& faults) {
  const Json& json = setting.value;
  if (!json.is(Json::Kind::text) || !json.text.starts_with("$")) return ParamValue{json, -1};
  if (json.text.starts_with("$$")) {
    ParamValue value{json, -1};
    value.json.text.erase(0, 1);
    return value;
  }
  const auto& where = scopes[std::size_t(setting.scope >= 0 ? setting.scope : scope)];
  const std::string name = json.text.substr(1);
  const int p = where.document->find_param(name);
  if (p < 0) {
    faults.error(json.position, path, fmt::format("the graph has no parameter '{}'", name),
                 {possibilities("it has", name, names_of(where.document->params)),
                  "a value that begins with a dollar is written with two: \"$$\""});
    return std::nullopt;
  }
  used_params.emplace(where.document, p);
  return where.params[std::size_t(p)];
}

std::optional<Expansion> expand(const Document& root, std::span<const Change> changes, Library& library,
                                Faults& faults) {
  Expander expander(library, faults);
  expander.root(root);
  std::vector<Addressed> addressed;
  for (const auto& c : changes) addressed.push_back({&c, 0, 0});
  expander.open(0, std::move(addressed));
  if (!faults.ok()) return std::nullopt;
  return std::move(expander.out);
}

}  // namespace quell
