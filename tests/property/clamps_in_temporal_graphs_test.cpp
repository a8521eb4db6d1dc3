// Every history clamp works in every shipped graph that blends history: both found from the tables alone, so that a new
// clamp or a new graph is held to this by being there.
#include "core/bench/synthetic_source.h"
#include "core/run/executor.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"
#include "tests/support/run_shipped.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace quell::test {
namespace {

constexpr int kWidth = 70, kHeight = 37, kFrames = 4;

// A node that takes history and the current frame. Bypassed, a clamp leaves history; a blend leaves the current frame.
bool takes_both(const NodeType& type, std::string_view passes) {
  const int in = type.find_input(passes);
  return in >= 0 && type.find_input("history") >= 0 && type.find_input("current") >= 0 &&
         type.outputs().front().passes == in;
}
bool is_clamp(const NodeType& type) { return takes_both(type, "history"); }
bool is_blend(const NodeType& type) { return takes_both(type, "current"); }

// One way to set a clamp: its defaults, or one choice or switch that is not.
struct Setting {
  const NodeType* type;
  int param = -1, value = 0;

  Instance instance() const {
    Instance made(*type);
    if (param >= 0 && type->params()[std::size_t(param)].kind == QUELL_BOOL)
      made.set_bool(param, value != 0);
    else if (param >= 0)
      made.set_int(param, value);
    return made;
  }
  std::string name() const {
    std::string text(type->name());
    if (param < 0) return text;
    const auto& p = type->params()[std::size_t(param)];
    return text + " " + p.name + " " + (p.kind == QUELL_BOOL ? std::to_string(value) : p.choices[value]);
  }
};

std::vector<Setting> settings() {
  std::vector<Setting> list;
  for (const auto* type : registry().all()) {
    if (!is_clamp(*type)) continue;
    list.push_back({type});
    for (std::size_t i = 0; i < type->params().size(); ++i) {
      const auto& p = type->params()[i];
      const int values = p.kind == QUELL_BOOL ? 2 : p.kind == QUELL_CHOICE ? p.choice_count : 0;
      for (int v = 0; v < values; ++v) list.push_back({type, int(i), v});
    }
  }
  return list;
}

std::vector<Wire>& wires_of(GraphNode& node, std::string_view input) {
  return node.in[std::size_t(node.type().find_input(input))];
}

// The blend's history through a clamp; where there is one already, that is replaced.
Graph with_clamp(Graph g, std::size_t blend, const Setting& setting) {
  GraphNode clamp{"clamp_under_test", setting.instance(), {}, {}, g.nodes[blend].position};
  clamp.in.resize(setting.type->inputs().size());
  clamp.out_types.assign(setting.type->outputs().size(), g.nodes[blend].out_types.at(0));
  auto history = wires_of(g.nodes[blend], "history");
  if (const int from = history.at(0).from.node; from >= 0 && is_clamp(g.nodes[std::size_t(from)].type()))
    history = wires_of(g.nodes[std::size_t(from)], "history");
  wires_of(clamp, "history") = history;
  wires_of(clamp, "current") = wires_of(g.nodes[blend], "current");
  g.nodes.insert(g.nodes.begin() + std::ptrdiff_t(blend), std::move(clamp));
  // It comes before the blend, so what comes from the blend on is one later.
  const auto later = [&](Source& s) { s.node += s.node >= int(blend); };
  const auto shift = [&](Wire& w) { later(w.from), later(w.start); };
  for (auto& node : g.nodes)
    for (auto& wires : node.in) std::ranges::for_each(wires, shift);
  for (auto& output : g.outputs) shift(output.wire);
  wires_of(g.nodes[blend + 1], "history") = {{{int(blend), 0}, 0, {}}};
  return g;
}

class Keep : public FrameSink {
 public:
  void write(std::int64_t, std::span<const quell_image> outputs) override {
    const auto& o = outputs[0];
    last = Image(o.width, o.height, o.channels);
    for (int c = 0; c < o.channels; ++c)
      for (int y = 0; y < o.height; ++y) std::copy_n(o.plane[c] + y * o.pitch, o.width, last.row(c, y));
  }
  Image last;
};

Image last_frame(const Graph& graph, int threads, int rows) {
  SyntheticSource source(graph, kWidth, kHeight, kFrames);
  Keep sink;
  RunOptions options;
  options.threads = threads, options.band_rows = rows;
  run_graph(graph, source, sink, options);
  return std::move(sink.last);
}

bool finite(const Image& image) {
  for (int c = 0; c < image.channels(); ++c)
    for (int y = 0; y < image.height(); ++y)
      if (!std::all_of(image.row(c, y), image.row(c, y) + image.width(), [](float v) { return std::isfinite(v); }))
        return false;
  return true;
}

class ClampsInTemporalGraphs : public testing::TestWithParam<std::string> {};

TEST_P(ClampsInTemporalGraphs, Work) {
  const Graph graph = shipped_graph(GetParam());
  int tried = 0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (!is_blend(graph.nodes[i].type()) || graph.nodes[i].out_types.at(0) != QUELL_RADIANCE) continue;
    Image plain = last_frame(graph, 1, 0);
    for (const auto& setting : settings()) {
      SCOPED_TRACE(graph.nodes[i].name + " with " + setting.name());
      const Graph clamped = with_clamp(graph, i, setting);
      const Image one = last_frame(clamped, 1, 0), many = last_frame(clamped, 3, 5);
      EXPECT_TRUE(finite(one));
      EXPECT_TRUE(same_bits(one, many)) << "threads and bands change bits";
      const bool there = std::ranges::any_of(graph.nodes, [](const auto& n) { return is_clamp(n.type()); });
      EXPECT_TRUE(there || !same_bits(one, plain)) << "it changes nothing";
      ++tried;
    }
  }
  EXPECT_GT(tried, 5);
}

std::vector<std::string> temporal_graphs() {
  std::vector<std::string> list;
  for (const auto& name : installed_graphs(QUELL_TEST_SOURCE "/graphs"))
    if (const Graph graph = shipped_graph(name);
        std::ranges::any_of(graph.nodes, [](const auto& n) { return is_blend(n.type()); }))
      list.push_back(name);
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, ClampsInTemporalGraphs, testing::ValuesIn(temporal_graphs()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quell::test
