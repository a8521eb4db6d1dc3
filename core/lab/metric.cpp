// A metric is loaded as any graph is; what is checked here is what makes a graph a metric.
#include "core/lab/metric.h"

#include "core/lab/halves.h"
#include "core/report/error.h"
#include "core/report/suggest.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace quell {

namespace fs = std::filesystem;

namespace {

bool is_file_name(const std::string& name) {
  return name.find('/') != name.npos || name.ends_with(".json") || name.starts_with("quell:");
}

// "" or what keeps a graph from being a metric.
std::string problem_of(const Graph& graph, const GraphInfo& info) {
  if (!info.metric) return "is no metric: it lacks \"metric\", as in \"metric\": { \"better\": \"lower\" }";
  const auto judged = std::ranges::find(info.inputs, kJudged, &GraphInput::name);
  if (judged == info.inputs.end())
    return fmt::format("is no metric: it lacks the input '{}', which is judged", kJudged);
  const auto value = std::ranges::find(graph.outputs, "value", &GraphOutput::name);
  if (value == graph.outputs.end()) return "is no metric: it lacks the output 'value', its number";
  for (const auto& out : graph.outputs) {
    if ((out.name == "value" || out.name == "pixels") && out.type != QUELL_VALUE)
      return fmt::format("gives '{}' as {}, but of a metric that is a value", out.name, type_name(out.type));
    if (out.name == "map" && out.type != QUELL_SCALAR)
      return fmt::format("gives 'map' as {}, but of a metric that is a scalar", type_name(out.type));
  }
  return "";
}

[[noreturn]] void refuse(const Metric& metric, const std::string& text) {
  throw Error(Exit::usage, fmt::format("the metric '{}' {}", metric.name, text));
}

// Where the metric's inputs come from in the graph.
class Joint {
 public:
  Joint(Graph& graph, int output, const Metric& metric)
      : metric_(metric), judged_(graph.outputs[std::size_t(output)]), first_(int(graph.nodes.size())) {
    for (const auto& in : metric.graph.inputs)
      inputs_.push_back(in.name == kJudged ? judged(in) : Wire{{Source::kInput, input_of(graph, in)}, 0, {}});
  }

  Wire wire(const Wire& w) const {
    Wire joined = source(w.from);
    if (w.delay == 0) return joined;
    if (joined.delay > 0)
      refuse(metric_, fmt::format("looks back at what it judges, but the output '{}' is delayed itself; let the graph "
                                  "give what it delays as an output",
                                  judged_.name));
    joined.delay = w.delay;
    if (w.start.node != Source::kNone) {
      const Wire start = source(w.start);
      joined.start = start.from;
    }
    return joined;
  }

 private:
  Wire judged(const GraphInput& in) const {
    if (in.type != judged_.type)
      refuse(metric_, fmt::format("judges {}, but the output '{}' is {}", type_name(in.type), judged_.name,
                                  type_name(judged_.type)));
    return judged_.wire;
  }
  int input_of(Graph& graph, const GraphInput& in) const {
    const auto same = std::ranges::find(graph.inputs, in.name, &GraphInput::name);
    if (same == graph.inputs.end()) {
      graph.inputs.push_back(in);
      return int(graph.inputs.size()) - 1;
    }
    if (same->type != in.type)
      refuse(metric_, fmt::format("takes '{}' as {}, but the graph takes it as {}", in.name, type_name(in.type),
                                  type_name(same->type)));
    return int(same - graph.inputs.begin());
  }
  Wire source(const Source& s) const {
    if (s.node == Source::kInput) return inputs_[std::size_t(s.port)];
    return {{s.node + first_, s.port}, 0, {}};
  }

  const Metric& metric_;
  const GraphOutput judged_;
  int first_;
  std::vector<Wire> inputs_;
};

}  // namespace

std::vector<std::string> installed_metrics(const fs::path& graphs) { return installed_graphs(graphs / "metrics"); }

std::optional<Metric> load_metric(const std::string& name, const fs::path& graphs, Registry& registry,
                                  Diagnostics& diagnostics, std::optional<std::map<std::string, int>> roles,
                                  std::vector<Edit> edits) {
  const auto known = installed_metrics(graphs);
  if (!is_file_name(name) && std::ranges::find(known, name) == known.end()) {
    diagnostics.error({}, "", fmt::format("there is no metric '{}'", name),
                      {possibilities("installed are", name, known), "a file is named with its folder or with .json"});
    return std::nullopt;
  }
  GraphRequest request;
  request.graph = is_file_name(name) ? name : fmt::format("quell:metrics/{}.json", name);
  request.graphs = graphs;
  request.roles = std::move(roles);
  request.edits = std::move(edits);
  GraphInfo info;
  auto graph = load_graph(request, registry, diagnostics, &info);
  if (!graph) return std::nullopt;
  if (const auto problem = problem_of(*graph, info); !problem.empty()) {
    diagnostics.error({}, "", fmt::format("'{}' {}", info.file, problem));
    return std::nullopt;
  }
  return Metric{fs::path(info.file).stem().string(), info.name, info.about, *info.metric, std::move(*graph)};
}

int reference_frames_back(const Graph& metric) {
  constexpr int kMost = 64;
  constexpr int kNever = -1;
  // By node: the most frames back that a reference is read, kNever where none is.
  std::vector<int> back(metric.nodes.size(), kNever);
  const auto of = [&](const Source& s) {
    if (s.node >= 0) return back[std::size_t(s.node)];
    return s.node == Source::kInput && is_reference(metric.inputs[std::size_t(s.port)].name) ? 0 : kNever;
  };
  const auto through = [&](const Wire& w) {
    const int from = of(w.from);
    return from == kNever ? of(w.start) : std::min(kMost, from + w.delay);
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t n = 0; n < metric.nodes.size(); ++n)
      for (const auto& port : metric.nodes[n].in)
        for (const auto& wire : port)
          if (const int b = through(wire); b > back[n]) back[n] = b, changed = true;
  }
  int most = kNever;
  for (const auto& out : metric.outputs) most = std::max(most, through(out.wire));
  return most;
}

void attach_metric(Graph& graph, int output, const Metric& metric, const std::string& prefix,
                   const std::vector<std::string>& wanted) {
  const Joint joint(graph, output, metric);
  for (auto node : metric.graph.nodes) {
    node.name = fmt::format("{}.{}", prefix, node.name);
    for (auto& port : node.in)
      for (auto& wire : port) wire = joint.wire(wire);
    graph.nodes.push_back(std::move(node));
  }
  for (const auto& out : metric.graph.outputs)
    if (std::ranges::find(wanted, out.name) != wanted.end())
      graph.outputs.push_back({fmt::format("{}.{}", prefix, out.name), joint.wire(out.wire), out.type, true});
}

}  // namespace quell
