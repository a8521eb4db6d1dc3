// How long a graph takes.
#include "core/bench/timing.h"

#include "core/report/error.h"
#include "core/run/reads.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace quell {

namespace {

class NoSink : public FrameSink {
 public:
  void write(std::int64_t, std::span<const quell_image>) override {}
};

std::size_t bytes_of(const quell_shape& s) {
  return std::size_t(s.width) * std::size_t(s.height) * std::size_t(s.channels) * sizeof(float);
}

std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    const double rank = share * double(values.size() - 1);
    const auto below = std::size_t(rank), above = std::min(below + 1, values.size() - 1);
    return values[below] + (rank - double(below)) * (values[above] - values[below]);
  };
  return {at(0.5), values[0], at(0.25), at(0.75)};
}

std::size_t traffic(const Plan& plan, std::size_t node) {
  const auto& graph = plan.graph();
  std::set<std::pair<std::size_t, int>> read;  // value and delay
  for_each_read(graph, node, [&](const Wire& wire) { read.emplace(plan.value_of(wire.from), wire.delay); });
  std::size_t bytes = 0;
  for (const auto& [value, delay] : read) bytes += bytes_of(plan.values()[value].shape);
  for (std::size_t o = 0; o < graph.nodes[node].type().outputs().size(); ++o)
    if (const auto& v = plan.values()[plan.value_of({int(node), int(o)})]; v.exists) bytes += bytes_of(v.shape);
  return bytes;
}

Timing measure(const Graph& graph, FrameSource& source, RunOptions options, int warmup) {
  std::vector<std::string> roles;
  for (const auto& input : graph.inputs) roles.push_back(input.name);
  if (source.frames().size() <= std::size_t(warmup)) throw Error(Exit::usage, "no frame is left to be measured");
  const Plan plan(graph, source.shapes(source.frames()[0], roles));

  std::vector<double> wall, cpu;
  std::vector<std::vector<double>> nodes(graph.nodes.size());
  TapCounter taps(graph.nodes.size());
  taps.on = warmup == 1;
  options.taps = &taps;
  int frame = 0;
  options.overlap = false;
  options.frame_times = [&](const FrameTimes& t) {
    taps.on = ++frame == warmup - 1;
    if (frame <= warmup) return;
    wall.push_back(1e3 * t.wall), cpu.push_back(1e3 * t.cpu);
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n].push_back(1e3 * t.nodes[n]);
  };
  NoSink sink;
  const auto report = run_graph(graph, source, sink, options);

  Timing m;
  m.graph = graph.name, m.fingerprint = fingerprint(graph);
  m.frames = int(wall.size()), m.warmup = warmup;
  m.threads = report.threads, m.resets = report.resets;
  m.ms = spread_of(wall), m.cpu_ms = spread_of(cpu);
  m.read_ms = 1e3 * report.read_wall / double(report.frames);
  m.image_bytes = report.plan_bytes, m.peak_bytes = peak_bytes();
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const auto& node = graph.nodes[n];
    if (node.type().is_weight()) continue;
    const auto& shape = plan.values()[plan.value_of({int(n), plan.nodes()[n].tiled})].shape;
    m.width = std::max(m.width, shape.width), m.height = std::max(m.height, shape.height);
    m.nodes.push_back({node.name, std::string(node.type().name()), spread_of(nodes[n]), traffic(plan, n),
                       std::size_t(shape.width) * std::size_t(shape.height), taps.taps(n)});
  }
  return m;
}

}  // namespace quell
