// Nodes stand in the graph's own order, each behind all that it reads, so that loading keeps that order.
#include "core/graph/write.h"

#include "core/graph/library.h"
#include "core/plugin/document.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quell {

namespace {

using J = nlohmann::ordered_json;

// As people write it: nlohmann's own text has no spaces at all, or a line for each value.
std::string spaced(const J& json) {
  std::vector<std::string> parts;
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) parts.push_back(fmt::format("\"{}\": {}", key, spaced(value)));
    return parts.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  if (json.is_array()) {
    for (const auto& item : json) parts.push_back(spaced(item));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  // A text from a command line need not be UTF-8.
  return json.dump(-1, ' ', false, J::error_handler_t::replace);
}

class Writer {
 public:
  Writer(const Graph& graph, const std::filesystem::path& graphs) : graph_(graph), graphs_(graphs) {}

  WrittenGraph write(const std::optional<MetricKey>& metric) {
    J inputs = J::object(), outputs = J::object();
    for (const auto& in : graph_.inputs) inputs[in.name] = std::string(type_name(in.type)) + (in.optional ? "?" : "");
    for (const auto& out : graph_.outputs)
      if (!out.tap) outputs[out.name] = wire(out.wire, out.type);
    std::vector<std::string> nodes;
    for (const auto& n : graph_.nodes)
      if (!n.preview) nodes.push_back(fmt::format("    \"{}\": {}", n.name, spaced(node(n))));
    auto& text = out_.text = "{\n  \"quell\": 1,\n";
    if (!graph_.name.empty()) text += fmt::format("  \"name\": {},\n", spaced(graph_.name));
    if (!graph_.about.empty()) text += fmt::format("  \"about\": {},\n", spaced(graph_.about));
    if (metric) text += fmt::format("  \"metric\": {},\n", spaced(key(*metric)));
    text += fmt::format("  \"inputs\": {},\n", spaced(inputs));
    text += fmt::format("  \"nodes\": {{\n{}\n  }},\n", fmt::join(nodes, ",\n"));
    text += fmt::format("  \"outputs\": {}\n}}\n", spaced(outputs));
    return std::move(out_);
  }

 private:
  static J key(const MetricKey& metric) {
    J j{{"better", metric.higher_is_better ? "higher" : "lower"}, {"unit", metric.unit}};
    j["perfect"] = metric.perfect ? J(*metric.perfect) : J();
    return j;
  }
  // `as` is the type that the reader sees; 0: the wire's own.
  J wire(const Wire& w, int as) const {
    J from = reference_text(graph_, w);
    const bool cast = as != 0 && as != graph_.type_of(w.from), start = w.start.node != Source::kNone;
    if (!cast && !start) return from;
    J object{{"from", std::move(from)}};
    if (start) object["start"] = reference_text(graph_, {w.start, 0, {}});
    if (cast) object["as"] = type_name(as);
    return object;
  }

  J node(const GraphNode& n) {
    J json{{"type", n.type().name()}};
    const auto ports = n.type().inputs();
    for (std::size_t p = 0; p < ports.size(); ++p) {
      if (n.in[p].empty()) continue;
      J wires = J::array();
      for (const auto& w : n.in[p]) wires.push_back(wire(w, type_seen(n, ports[p])));
      json["in"][ports[p].name] = (ports[p].flags & QUELL_LIST) ? std::move(wires) : std::move(wires[0]);
    }
    if (untold(n)) tell(n, json["in"]);
    for (std::size_t i = 0; i < n.type().params().size(); ++i)
      if (auto value = setting(n, int(i)); !value.is_null()) json["set"][n.type().params()[i].name] = std::move(value);
    return json;
  }

  // What a port takes its wires as, or 0 for whatever they are.
  int type_seen(const GraphNode& n, const quell_port& port) const {
    if (port.type != QUELL_ANY) return port.type;
    if (!n.type().shares_type(port)) return 0;
    for (std::size_t o = 0; o < n.out_types.size(); ++o)
      if (n.type().outputs()[o].type == QUELL_ANY) return n.out_types[o];
    // Nothing hangs on which type it is, as long as all are one; features can be taken as anything, so others win.
    int type = 0;
    each_variable(n, [&](const Wire& w) {
      if (type == 0 || type == QUELL_FEATURES) type = graph_.type_of(w.from);
    });
    return type;
  }

  template <class Use>
  static void each_variable(const GraphNode& n, Use use) {
    for (std::size_t p = 0; p < n.in.size(); ++p)
      if (const auto& port = n.type().inputs()[p]; port.type == QUELL_ANY && n.type().shares_type(port))
        for (const auto& w : n.in[p]) use(w);
  }

  // Nothing that stands before the node tells the type of its variable. Where that holds all around a loop, the graph
  // had a cast that says it, and the cast is lost once types are bound.
  bool untold(const GraphNode& n) const {
    bool any = false, told = false;
    each_variable(n, [&](const Wire& w) {
      any = true;
      const bool variable =
          w.from.node >= 0 &&
          graph_.nodes[std::size_t(w.from.node)].type().outputs()[std::size_t(w.from.port)].type == QUELL_ANY;
      told |= w.delay == 0 || w.start.node != Source::kNone || !variable;
    });
    return any && !told;
  }
  void tell(const GraphNode& n, J& in) const {
    for (std::size_t p = 0; p < n.in.size(); ++p) {
      const auto& port = n.type().inputs()[p];
      if (n.in[p].empty() || port.type != QUELL_ANY || !n.type().shares_type(port)) continue;
      J& first = (port.flags & QUELL_LIST) ? in[port.name][0] : in[port.name];
      if (first.is_string()) first = {{"from", first}, {"as", type_name(type_seen(n, port))}};
      return;
    }
  }

  // Null for what is not written: a default that names a file, and a file that a graph cannot name.
  J setting(const GraphNode& n, int i) {
    const auto kind = n.type().params()[std::size_t(i)].kind;
    if (kind == QUELL_PATH) return path(n, i);
    J value = J::parse(value_json(n.instance, i));
    // A dollar in front would name a parameter of the graph.
    if (kind == QUELL_TEXT && value.get_ref<const std::string&>().starts_with("$"))
      value = "$" + value.get<std::string>();
    return value;
  }

  J path(const GraphNode& n, int i) {
    const std::string text(n.instance.get_text(i));
    if (text == Instance(n.type()).get_text(i)) return nullptr;
    if (text.empty()) return text;
    if (auto name = installed_name(graphs_, text)) return *name;
    out_.files.push_back(fmt::format("{}.{}={}", n.name, n.type().params()[std::size_t(i)].name, text));
    return nullptr;
  }

  const Graph& graph_;
  const std::filesystem::path& graphs_;
  WrittenGraph out_;
};

}  // namespace

WrittenGraph write_graph(const Graph& graph, const std::filesystem::path& graphs,
                         const std::optional<MetricKey>& metric) {
  return Writer(graph, graphs).write(metric);
}

std::string reference_text(const Graph& graph, const Wire& w) {
  std::string text;
  if (w.from.node == Source::kInput) {
    text = graph.inputs[std::size_t(w.from.port)].name;
  } else {
    const auto& node = graph.nodes[std::size_t(w.from.node)];
    const auto outputs = node.type().outputs();
    text = outputs.size() == 1 ? node.name : fmt::format("{}.{}", node.name, outputs[std::size_t(w.from.port)].name);
  }
  return w.delay ? fmt::format("{}@-{}", text, w.delay) : text;
}

}  // namespace quell
