// What every shipped graph keeps as a whole: found in the folder of graphs, so that a new one is held to this by being
// there.
#include "tests/support/altered_frames.h"
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

constexpr int kWidth = 96, kHeight = 54;

std::vector<std::string> graphs(bool (*wanted)(const Graph&)) {
  std::vector<std::string> list;
  for (const auto& name : installed_graphs(QUELL_TEST_SOURCE "/graphs"))
    if (wanted(shipped_graph(name))) list.push_back(name);
  return list;
}

bool remembers(const Graph& graph) {
  return std::ranges::any_of(graph.nodes, [](const GraphNode& node) {
    return std::ranges::any_of(node.in, [](const auto& wires) {
      return std::ranges::any_of(wires, [](const Wire& w) { return w.delay > 0; });
    });
  });
}

class TemporalGraph : public testing::TestWithParam<std::string> {};

// Nothing crosses a cut: what follows has the bits of a run that begins there.
TEST_P(TemporalGraph, StartsAnewOnACut) {
  const Graph graph = shipped_graph(GetParam());
  const SyntheticRun all{.width = kWidth, .height = kHeight, .last = 7};
  SyntheticRun cut = all, fresh = all;
  cut.cut = fresh.first = 4;
  const auto uncut = run_synthetic(graph, all), before_and_after = run_synthetic(graph, cut),
             after = run_synthetic(graph, fresh);
  for (const auto& [frame, images] : after) {
    EXPECT_TRUE(same_bits(images[0], before_and_after.at(frame)[0])) << frame;
    EXPECT_FALSE(same_bits(images[0], uncut.at(frame)[0])) << frame << ": no history to lose";
  }
  for (int frame = 0; frame < 4; ++frame)
    EXPECT_TRUE(same_bits(uncut.at(frame)[0], before_and_after.at(frame)[0])) << frame << ": a cut looks ahead";
}

INSTANTIATE_TEST_SUITE_P(All, TemporalGraph, testing::ValuesIn(graphs(remembers)),
                         [](const auto& test) { return test.param; });

// The graph with the part that finds cuts in place of its disocclusion.
Graph cut_aware(const std::string& name) {
  GraphRequest request;
  request.graph = name;
  request.graphs = QUELL_TEST_SOURCE "/graphs";
  Diagnostics diagnostics;
  request.laid_over = parse_json(
      "variant", R"({"nodes": {"validity": {"graph": "quell:parts/cut_aware_disocclusion.json"}}})", diagnostics);
  auto graph = load_graph(request, registry(), diagnostics);
  if (!graph) throw std::runtime_error(diagnostics.format());
  return std::move(*graph);
}

bool tests_surfaces_alone(const Graph& graph) {
  const auto is = [](const GraphNode& n, std::string_view name, std::string_view type) {
    return n.name == name && n.type().name() == type;
  };
  return std::ranges::any_of(graph.nodes, [&](const auto& n) { return is(n, "validity", "disocclusion"); }) &&
         std::ranges::any_of(graph.inputs, [](const auto& i) { return i.type == QUELL_DEPTH || i.type == QUELL_ID; }) &&
         std::ranges::none_of(graph.nodes, [](const auto& n) { return n.type().name() == "cut_gate"; });
}

class CutAwareGraph : public testing::TestWithParam<std::string> {};

// Surfaces change in two thirds of the frame, and nothing declares it.
TEST_P(CutAwareGraph, StartsAnewOnACutThatNobodyDeclares) {
  const Graph plain = shipped_graph(GetParam()), aware = cut_aware(GetParam());
  SyntheticRun all{.width = kWidth, .height = kHeight, .last = 6};
  all.alter = [](const Image& image, int type, std::int64_t frame) {
    auto other = image.copy();
    if (frame < 4) return other;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth * 2 / 3; ++x) {
        if (type == QUELL_DEPTH) other.at(0, x, y) += 20;
        if (type == QUELL_ID) other.bits(0, y)[x] += 1000;
      }
    return other;
  };
  SyntheticRun fresh = all;
  fresh.first = 4;
  const auto found = run_synthetic(aware, all), missed = run_synthetic(plain, all), after = run_synthetic(aware, fresh);
  for (const auto& [frame, images] : after) {
    EXPECT_TRUE(same_bits(images[0], found.at(frame)[0])) << frame;
    EXPECT_FALSE(same_bits(images[0], missed.at(frame)[0])) << frame << ": no history to lose";
  }
  EXPECT_TRUE(same_bits(found.at(3)[0], missed.at(3)[0])) << "it changes what has no cut";
}

INSTANTIATE_TEST_SUITE_P(All, CutAwareGraph, testing::ValuesIn(graphs(tests_surfaces_alone)),
                         [](const auto& test) { return test.param; });

class ShippedGraph : public testing::TestWithParam<std::string> {};

// Images, motion and cameras in a mirror: the result in that mirror. Sums are taken in another order, and a luminance
// weight of little variance magnifies their rounding at a few pixels.
TEST_P(ShippedGraph, CommutesWithFlips) {
  const Graph graph = shipped_graph(GetParam());
  const SyntheticRun plain{.width = kWidth, .height = kHeight, .last = 3};
  const auto expected = run_synthetic(graph, plain);
  for (const bool horizontal : {true, false}) {
    SyntheticRun flipped = plain;
    flipped.alter = [&](const Image& image, int type, std::int64_t) {
      if (type != QUELL_CAMERA) return mirrored(image, type, horizontal);
      return mirrored_camera(image, horizontal, float(horizontal ? kWidth : kHeight));
    };
    double sum = 0, difference = 0;
    for (const auto& [frame, images] : run_synthetic(graph, flipped)) {
      const Image back = mirrored(images[0], graph.outputs[0].type, horizontal);
      for (int c = 0; c < back.channels(); ++c)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const double want = expected.at(frame)[0].at(c, x, y), off = std::abs(back.at(c, x, y) - want);
            ASSERT_LE(off, 0.01 * want + 1e-5) << frame << ": " << x << "," << y << (horizontal ? " across" : " down");
            sum += want, difference += off;
          }
    }
    EXPECT_LE(difference, 3e-6 * sum);
  }
}

// Whether a number of this node is measured in radiance: its documentation says so.
bool in_radiance(const Graph& graph, const GraphNode& node, const quell_param& p) {
  const std::string_view doc = p.doc;
  if (doc.ends_with("or radiance without a variance."))
    return node.in[std::size_t(node.type().find_input("variance"))].empty();
  if (doc.ends_with("in units of the image."))
    return graph.type_of(node.in[std::size_t(node.type().find_input("image"))].at(0).from) == QUELL_RADIANCE;
  return doc.ends_with("radiance.");
}

// Four times the light, and thresholds that are radiances with it, give four times the result, to the bit. A scale of
// log(1 + x) has no exposure to follow, so it is set aside.
TEST_P(ShippedGraph, FollowsTheExposure) {
  constexpr float kScale = 4;
  Graph graph = shipped_graph(GetParam());
  for (auto& node : graph.nodes)
    if (const int compress = node.type().find_param("compress"); compress >= 0) node.instance.set_bool(compress, false);
  const SyntheticRun plain{.width = kWidth, .height = kHeight, .last = 3};
  const auto expected = run_synthetic(graph, plain);
  for (auto& node : graph.nodes)
    for (std::size_t i = 0; i < node.type().params().size(); ++i)
      if (in_radiance(graph, node, node.type().params()[i]))
        node.instance.set_float(int(i), kScale * node.instance.get_float(int(i)));
  SyntheticRun bright = plain;
  bright.alter = [](const Image& image, int type, std::int64_t) { return brightened(image, type, kScale); };
  for (const auto& [frame, images] : run_synthetic(graph, bright))
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          ASSERT_EQ(images[0].at(c, x, y), kScale * expected.at(frame)[0].at(c, x, y))
              << frame << ": " << x << "," << y;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedGraph, testing::ValuesIn(graphs([](const Graph&) { return true; })),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quell::test
