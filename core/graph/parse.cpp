// JSON to document: keys, kinds and names, and the syntax of wires.
#include "core/graph/document.h"
#include "core/report/suggest.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

class Parser {
 public:
  explicit Parser(Faults& faults) : faults_(faults) {}

  std::optional<Document> document(const Json& json) {
    if (!kind(json, Json::Kind::object, "", "a graph")) return std::nullopt;
    keys(json, "", {"quell", "name", "about", "metric", "inputs", "params", "nodes", "outputs", "$schema"});
    Document d;
    d.position = json.position;
    version(json);
    if (const auto* j = json.find("name"); j && kind(*j, Json::Kind::text, "name", "the name")) d.name = j->text;
    if (const auto* j = json.find("$schema")) kind(*j, Json::Kind::text, "$schema", "the address");
    if (const auto* j = json.find("about"); j && kind(*j, Json::Kind::text, "about", "the text")) d.about = j->text;
    if (const auto* j = json.find("metric"); j && kind(*j, Json::Kind::object, "metric", "\"metric\"")) metric(d, *j);
    section(json, "inputs", [&](const JsonMember& m) { input(d, m); });
    section(json, "params", [&](const JsonMember& m) { param(d, m); });
    section(json, "nodes", [&](const JsonMember& m) { node(d, m); });
    for (const auto& n : d.nodes) stands_alone(d, n);
    section(json, "outputs", [&](const JsonMember& m) { output(d, m); });
    if (!json.find("outputs"))
      faults_.error(json.position, "", "a graph needs \"outputs\"",
                    {"as in \"outputs\": { \"color\": \"blur.image\" }"});
    else if (json.find("outputs")->is(Json::Kind::object) && d.outputs.empty() && faults_.ok())
      faults_.error(json.find("outputs")->position, "outputs", "a graph needs an output",
                    {"as in \"outputs\": { \"color\": \"blur.image\" }"});
    if (!faults_.ok()) return std::nullopt;
    return d;
  }

  std::optional<Binding> binding(const std::string& port, TextPosition position, const Json& json,
                                 const std::string& path) {
    Binding b{port, position, json.is(Json::Kind::list), {}};
    if (!b.list) {
      auto w = wire(json, path);
      if (!w) return std::nullopt;
      b.wires.push_back(std::move(*w));
      return b;
    }
    bool good = true;
    for (std::size_t i = 0; i < json.items.size(); ++i) {
      if (auto w = wire(json.items[i], fmt::format("{}[{}]", path, i)))
        b.wires.push_back(std::move(*w));
      else
        good = false;
    }
    return good ? std::optional(std::move(b)) : std::nullopt;
  }

 private:
  bool kind(const Json& json, Json::Kind wanted, const std::string& path, std::string_view what) {
    if (json.kind == wanted) return true;
    Json example;
    example.kind = wanted;
    faults_.error(json.position, path, fmt::format("{} must be {}, not {}", what, example.kind_name(), shown(json)));
    return false;
  }
  static std::string shown(const Json& json) {
    const bool plain = json.is(Json::Kind::null) || json.is(Json::Kind::boolean) || json.is(Json::Kind::list) ||
                       json.is(Json::Kind::object);
    return plain && !json.is(Json::Kind::boolean) ? json.kind_name() : json.shown();
  }

  void keys(const Json& json, const std::string& path, std::initializer_list<const char*> known) {
    const std::vector<std::string> names(known.begin(), known.end());
    for (const auto& m : json.members)
      if (std::find(names.begin(), names.end(), m.key) == names.end())
        faults_.error(m.key_position, path, fmt::format("unknown key '{}'", m.key),
                      {possibilities("the keys are", m.key, names)});
  }

  void version(const Json& json) {
    const auto* v = json.find("quell");
    if (!v)
      faults_.error(json.position, "", "this is no graph: it does not begin with \"quell\": 1");
    else if (!v->is(Json::Kind::integer) || v->integer != 1)
      faults_.error(v->position, "quell", fmt::format("this program reads version 1, not {}", v->shown()));
  }

  template <class Each>
  void section(const Json& json, const std::string& name, Each each) {
    const auto* j = json.find(name);
    if (!j || !kind(*j, Json::Kind::object, name, fmt::format("\"{}\"", name))) return;
    for (const auto& m : j->members) each(m);
  }

  bool named(const JsonMember& m, const std::string& path, bool dotted = false) {
    if (dotted ? !split_path(m.key).empty() : is_identifier(m.key)) return true;
    faults_.error(m.key_position, path, fmt::format("'{}' cannot be a name", m.key),
                  {"a name is a small letter, then small letters, digits and _"});
    return false;
  }

  void metric(Document& d, const Json& json) {
    keys(json, "metric", {"better", "unit", "perfect"});
    auto& metric = d.metric.emplace();
    const auto* better = json.find("better");
    if (!better)
      faults_.error(json.position, "metric", "a metric needs \"better\"",
                    {"as in \"metric\": { \"better\": \"lower\", \"unit\": \"dB\", \"perfect\": 0 }"});
    else if (!better->is(Json::Kind::text) || (better->text != "lower" && better->text != "higher"))
      faults_.error(better->position, "metric.better",
                    fmt::format("\"better\" must be \"lower\" or \"higher\", not {}", shown(*better)));
    else
      metric.higher_is_better = better->text == "higher";
    if (const auto* j = json.find("unit"); j && kind(*j, Json::Kind::text, "metric.unit", "the unit"))
      metric.unit = j->text;
    if (const auto* j = json.find("perfect"); j && !j->is(Json::Kind::null)) {
      if (j->is_number())
        metric.perfect = j->number;
      else
        faults_.error(j->position, "metric.perfect",
                      fmt::format("\"perfect\" must be a number or null, not {}", shown(*j)));
    }
  }

  void input(Document& d, const JsonMember& m) {
    const std::string path = "inputs." + m.key;
    if (!named(m, "inputs") || !kind(m.value, Json::Kind::text, path, "a type")) return;
    InputSpec in{m.key, m.key_position, 0, false, false};
    std::string name = m.value.text;
    if (name.ends_with("?")) in.optional = true, name.pop_back();
    if (name.ends_with("[]")) in.list = true, name.resize(name.size() - 2);
    if (name == "any") {
      in.type = QUELL_ANY;
    } else if (const auto* info = type_info(std::string_view(name))) {
      in.type = info->type;
    } else {
      auto names = names_of(kTypes);
      faults_.error(m.value.position, path, fmt::format("there is no type '{}'", name),
                    {fmt::format("types: {}", fmt::join(names, ", ")), meant(name, names)});
      return;
    }
    d.input_index.emplace(m.key, int(d.inputs.size()));
    d.inputs.push_back(std::move(in));
  }
  static std::string meant(const std::string& name, const std::vector<std::string>& names) {
    const std::string near = nearest(name, names);
    return near.empty() ? "" : fmt::format("Did you mean '{}'?", near);
  }

  void param(Document& d, const JsonMember& m) {
    const std::string path = "params." + m.key;
    if (!named(m, "params")) return;
    if (m.value.is(Json::Kind::null) || m.value.is(Json::Kind::object)) {
      faults_.error(m.value.position, path, fmt::format("a parameter needs a value, not {}", m.value.kind_name()));
      return;
    }
    if (m.value.is(Json::Kind::text) && m.value.text.starts_with("$") && !m.value.text.starts_with("$$")) {
      faults_.error(m.value.position, path,
                    fmt::format("a parameter cannot refer to another, as {} does", m.value.shown()),
                    {"write \"$$\" for a dollar"});
      return;
    }
    d.param_index.emplace(m.key, int(d.params.size()));
    d.params.push_back({m.key, m.key_position, m.value});
  }

  void node(Document& d, const JsonMember& m) {
    if (!named(m, "nodes", true) || !kind(m.value, Json::Kind::object, m.key, "a node")) return;
    if (const int i = d.find_input(m.key); i >= 0) {
      faults_.error(m.key_position, m.key, fmt::format("'{}' is both an input and a node", m.key),
                    {fmt::format("the input is at {}", faults_.sources().place(d.inputs[std::size_t(i)].position))});
      return;
    }
    keys(m.value, m.key, {"type", "graph", "in", "set", "bypass"});
    NodeSpec n;
    n.name = m.key;
    n.position = m.key_position;
    const auto *type = m.value.find("type"), *graph = m.value.find("graph");
    if (type && graph) {
      faults_.error(graph->position, m.key, "a node has a type or a graph, not both");
    } else if (!type && !graph) {
      faults_.error(m.key_position, m.key, "a node needs a \"type\" or a \"graph\"");
    } else {
      const auto& j = type ? *type : *graph;
      if (kind(j, Json::Kind::text, m.key + (type ? ".type" : ".graph"), type ? "a type" : "a graph"))
        n.type = j.text, n.type_position = j.position, n.graph = !type;
    }
    if (const auto* b = m.value.find("bypass"); b && kind(*b, Json::Kind::boolean, m.key + ".bypass", "\"bypass\""))
      n.bypass = b->boolean, n.bypass_position = b->position;
    if (const auto* in = m.value.find("in"); in && kind(*in, Json::Kind::object, m.key + ".in", "\"in\""))
      for (const auto& w : in->members)
        if (auto b = binding(w.key, w.key_position, w.value, m.key + ".in." + w.key)) n.in.push_back(std::move(*b));
    if (const auto* set = m.value.find("set"); set && kind(*set, Json::Kind::object, m.key + ".set", "\"set\""))
      for (const auto& s : set->members) n.set.push_back({s.key, s.key_position, s.value});
    d.node_index.emplace(m.key, int(d.nodes.size()));
    d.nodes.push_back(std::move(n));
  }

  // "a.b" would be a port of "a" too.
  void stands_alone(const Document& d, const NodeSpec& n) {
    for (auto dot = n.name.find('.'); dot != n.name.npos; dot = n.name.find('.', dot + 1)) {
      const std::string front = n.name.substr(0, dot);
      if (d.find_node(front) >= 0 || d.find_input(front) >= 0)
        faults_.error(n.position, n.name, fmt::format("'{}' cannot be a name beside '{}'", n.name, front),
                      {fmt::format("'{}' would be a port of '{}'", n.name, front)});
    }
  }

  void output(Document& d, const JsonMember& m) {
    const std::string path = "outputs." + m.key;
    if (!named(m, "outputs")) return;
    if (auto w = wire(m.value, path)) {
      d.output_index.emplace(m.key, int(d.outputs.size()));
      d.outputs.push_back({m.key, m.key_position, std::move(*w)});
    }
  }

  bool reference(const Json& json, const std::string& path, Reference& out) {
    if (!json.is(Json::Kind::text)) {
      faults_.error(json.position, path, fmt::format("a wire must be text, not {}", shown(json)),
                    {"as in \"node.port\", \"node.port@-1\" or { \"from\": \"node.port\", \"as\": \"radiance\" }"});
      return false;
    }
    const auto problem = parse_reference(json.text, out);
    if (problem.text.empty()) return true;
    faults_.error(json.position, path, problem.text, {problem.note});
    return false;
  }

  std::optional<WireSpec> wire(const Json& json, const std::string& path) {
    WireSpec w;
    w.position = json.position;
    if (!json.is(Json::Kind::object)) return reference(json, path, w.from) ? std::optional(std::move(w)) : std::nullopt;
    keys(json, path, {"from", "start", "as"});
    const auto* from = json.find("from");
    if (!from) {
      faults_.error(json.position, path, "a wire needs \"from\"");
      return std::nullopt;
    }
    bool good = reference(*from, path, w.from);
    if (const auto* start = json.find("start")) {
      w.start.emplace();
      w.start_position = start->position;
      if (!reference(*start, path + ".start", *w.start)) {
        good = false;
      } else if (good && w.from.delay == 0) {
        good = false;
        faults_.error(start->position, path + ".start", "only a delayed wire has a start",
                      {fmt::format("'{}' reads this frame; write {}@-1 for the frame before", from->text, from->text)});
      } else if (w.start->delay != 0) {
        good = false;
        faults_.error(start->position, path + ".start",
                      fmt::format("a start cannot be delayed, as '{}' is", start->text));
      }
    }
    if (const auto* as = json.find("as")) {
      const auto* info = as->is(Json::Kind::text) ? type_info(std::string_view(as->text)) : nullptr;
      if (!info) {
        auto names = names_of(kTypes);
        faults_.error(as->position, path + ".as",
                      as->is(Json::Kind::text) ? fmt::format("there is no type '{}'", as->text)
                                               : fmt::format("a type must be text, not {}", shown(*as)),
                      {fmt::format("types: {}", fmt::join(names, ", ")), meant(as->text, names)});
        return std::nullopt;
      }
      w.as = info->type;
    }
    return good ? std::optional(std::move(w)) : std::nullopt;
  }

  Faults& faults_;
};

}  // namespace

Document::Found Document::find_node(std::span<const std::string> path) const {
  std::string front;
  for (std::size_t parts = 1; parts <= path.size(); ++parts) {
    front += (parts > 1 ? "." : "") + path[parts - 1];
    if (const int node = find_node(front); node >= 0) return {node, parts};
  }
  return {};
}

std::optional<Document> parse_document(const Json& json, Faults& faults) { return Parser(faults).document(json); }

std::optional<Binding> parse_binding(const std::string& port, TextPosition position, const Json& json,
                                     const std::string& path, Faults& faults) {
  return Parser(faults).binding(port, position, json, path);
}

}  // namespace quell
