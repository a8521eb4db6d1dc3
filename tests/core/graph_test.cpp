// Whole graphs: what good ones come to be, stage by stage.
#include "tests/support/graph_nodes.h"
#include "tests/support/paths.h"
#include "tests/support/scratch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

namespace quell::test {
namespace {

using Kind = Edit::Kind;

TEST(Graph, LoadsSvgf) {
  const auto l = load_svgf();
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.messages, "");
  EXPECT_EQ(l.graph->name, "SVGF");
  EXPECT_EQ(l.graph->nodes.size(), 30u);
  EXPECT_EQ(l.graph->nodes.front().name, "demodulate");
  EXPECT_EQ(l.graph->nodes.back().name, "modulate");
  EXPECT_EQ(line_of(l, "history"), "history <- image:level0.atrous.image@-1 motion:motion taps:surface.taps");
  EXPECT_EQ(line_of(l, "level1.atrous"),
            "level1.atrous <- image:level0.atrous.image variance:level0.atrous.variance weights:by_normal.weight "
            "weights:by_depth.weight weights:level1.by_luminance.weight");
  const auto& steady = node_called(*l.graph, "level3.steady");
  EXPECT_EQ(steady.instance.describe(), "kernel=binomial sigma=1 radius=1");
  EXPECT_EQ(steady.out_types, std::vector<int>{QUELL_VARIANCE});
  EXPECT_EQ(node_called(*l.graph, "moments_history").out_types, std::vector<int>{QUELL_MOMENTS});
  EXPECT_EQ(node_called(*l.graph, "history").out_types, std::vector<int>{QUELL_RADIANCE});
  EXPECT_EQ(node_called(*l.graph, "level4.atrous").instance.get_int(0), 16);
  EXPECT_EQ(node_called(*l.graph, "level0.atrous").position.source, 1) << "it stands in the subgraph's file";
}

TEST(Graph, OrderIsThatOfTheFileWhereItMayBe) {
  const auto l = load_svgf();
  ASSERT_TRUE(l.graph);
  std::set<std::string> seen;
  for (const auto& n : l.graph->nodes) {
    for (const auto& port : n.in)
      for (const auto& w : port) {
        const bool before = w.delay == 0 && w.from.node >= 0;
        EXPECT_TRUE(!before || seen.contains(l.graph->nodes[std::size_t(w.from.node)].name)) << n.name;
      }
    seen.insert(n.name);
  }
}

TEST(Graph, TellsItsParameters) {
  const auto l = load_svgf({{Kind::set, "alpha=0.3"}});
  ASSERT_EQ(l.info.params.size(), 7u);
  EXPECT_EQ(l.info.params[0].name, "alpha");
  EXPECT_EQ(l.info.params[0].value, "0.3");
  EXPECT_EQ(l.info.params[0].takes, "a number from 0 to 1");
  EXPECT_EQ(l.info.params[0].doc, "Weight of this frame once warmed up.");
  EXPECT_EQ(l.info.params[0].feeds, std::vector<std::string>{"blend.alpha"});
  EXPECT_EQ(l.info.params[4].name, "sigma_luminance");
  EXPECT_EQ(l.info.params[4].feeds.size(), 5u) << "one a level";
  EXPECT_EQ(l.info.outputs, std::vector<std::string>{"color"});
  EXPECT_EQ(l.info.inputs.size(), 6u);
}

TEST(Graph, DollarsAreLiteralWhenDoubled) {
  const auto l = load_text(
      R"({"quell": 1, "inputs": {"color": "radiance"}, "params": {"p": "$$x"}, "outputs": {"a": "a", "b": "b"}, "nodes": {
          "a": {"type": "grade", "in": {"image": "color"}, "set": {"look": "$p"}},
          "b": {"type": "grade", "in": {"image": "color"}, "set": {"look": "$$p"}}}})");
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[0].instance.get_text(1), "$x");
  EXPECT_EQ(l.graph->nodes[1].instance.get_text(1), "$p");
}

TEST(Graph, APathFromTheCommandLineMayBeAnyFile) {
  Scratch scratch;
  std::ofstream(scratch.path("table.cube")) << "x";
  const auto l = load_text(graph_with(R"("b": {"type": "grade", "in": {"image": "color"}})"),
                           {{Kind::set, "b.table=" + scratch.path("table.cube")}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[0].instance.get_text(2), scratch.path("table.cube"));
}

TEST(Graph, InstalledGraphsAndFilesAreFoundByName) {
  GraphRequest request;
  request.graph = "svgf";
  request.graphs = std::string(QUELL_TEST_SOURCE) + "/tests/core/graphs";
  EXPECT_TRUE(load(request).graph);
  request.graph = "svfg";
  EXPECT_EQ(load(request).messages,
            "error: there is no graph 'svfg'\n  installed are: svgf. Did you mean 'svgf'?\n"
            "  a file is named with its folder or with .json\n");
  EXPECT_EQ(installed_graphs(request.graphs), std::vector<std::string>{"svgf"});
}

TEST(Graph, AnIdentityNeedsNoNodes) {
  const auto l = load_text(R"({"quell": 1, "inputs": {"color": "radiance"}, "outputs": {"color": "color"}})");
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(shown(*l.graph), "color = color\n");
}

TEST(Graph, AbsentOptionalInputsLeaveOptionalPortsOpen) {
  GraphRequest request;
  request.graph = svgf_file();
  request.roles = Roles{};
  for (const auto* name : {"color", "albedo", "normal", "depth", "motion"})
    (*request.roles)[name] = conventional_role(name);
  const auto l = load(request);
  EXPECT_EQ(line_of(l, "surface"),
            "surface <- motion:motion slope:slope.slope depth:depth depth_before:depth@-1 normal:normal "
            "normal_before:normal@-1");
}

TEST(Graph, RolesAreCompared) {
  GraphRequest request;
  request.graph = svgf_file();
  request.roles = Roles{{"color", QUELL_RADIANCE},
                        {"albedo", QUELL_ALBEDO},
                        {"normal", QUELL_NORMAL},
                        {"depth", QUELL_SCALAR},
                        {"moton", QUELL_MOTION}};
  const auto l = load(request);
  EXPECT_FALSE(l.graph);
  EXPECT_EQ(l.messages,
            svgf_file() +
                ":6:66: error: inputs.depth: the sequence gives 'depth' as scalar, but the graph takes depth\n" +
                svgf_file() +
                ":6:84: error: inputs.motion: the sequence has no 'motion'\n"
                "  it has: albedo, color, depth, moton, normal. Did you mean 'moton'?\n");
}

TEST(Graph, OutputsThatDependOnAnInputGoWithIt) {
  // Without a variance the à-trous level has no variance to give, and neither has the next.
  const auto l = load_text(graph_with(R"(
      "a": {"type": "atrous", "in": {"image": "color"}},
      "c": {"type": "atrous", "in": {"image": "a.image", "variance": "a.variance"}},
      "b": {"type": "atrous", "in": {"image": "c.image", "variance": "c.variance"}})",
                                      "\"color\": \"b.image\""));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(shown(*l.graph), "a <- image:color\nc <- image:a.image\nb <- image:c.image\ncolor = b.image\n");
}

TEST(Graph, DelaysAddUpThroughBypassedNodes) {
  const auto l = load_text(graph_with(R"(
      "a": {"type": "outlier_clamp", "in": {"image": "color@-2"}, "bypass": true},
      "b": {"type": "modulate", "in": {"image": "a@-1", "albedo": "albedo"}})"));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(shown(*l.graph), "b <- image:color@-3 albedo:albedo\ncolor = b.image\n");
}

TEST(Graph, CastsAreExplicit) {
  const auto l = load_text(graph_with(R"(
      "b": {"type": "outlier_clamp", "in": {"image": {"from": "normal", "as": "radiance"}}},
      "c": {"type": "gaussian", "in": {"image": {"from": "depth@-1", "as": "scalar"}}})",
                                      R"("color": "b", "s": "c", "n": {"from": "normal", "as": "albedo"})"));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[1].out_types[0], QUELL_SCALAR);
  EXPECT_EQ(l.graph->outputs[2].type, QUELL_ALBEDO);
}

TEST(Graph, TypeVariablesAreBoundThroughLoops) {
  // The blend's history comes from itself; its current frame tells the type of both.
  const auto l = load_text(graph_with(R"(
      "n": {"type": "history_length", "in": {"before": "n@-1", "motion": "motion", "taps": "t"}},
      "t": {"type": "disocclusion", "in": {"motion": "motion"}},
      "r": {"type": "reproject", "in": {"image": "b@-1", "motion": "motion", "taps": "t"}},
      "b": {"type": "temporal_blend", "in": {"history": "r", "current": "normal", "count": "n"}})"));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node_called(*l.graph, "r").out_types[0], QUELL_NORMAL);
  EXPECT_EQ(l.graph->outputs[0].type, QUELL_NORMAL);
}

// Where no output is of type any, nothing binds the images of a list to one type.
TEST(Graph, ImagesOfAListMayEachHaveTheirType) {
  const auto packed =
      load_text(graph_with(R"("b": {"type": "pack", "in": {"images": ["color", "depth", "normal@-1"]}})"));
  ASSERT_TRUE(packed.graph) << packed.messages;
  EXPECT_EQ(packed.graph->outputs[0].type, QUELL_FEATURES);
  const auto ids = load_text(graph_with(R"("b": {"type": "pack", "in": {"images": ["color", "id"]}})"));
  EXPECT_FALSE(ids.graph);
  EXPECT_NE(ids.messages.find("b.in.images[1]: 'id' is id, but 'images' takes an image of numbers"), std::string::npos)
      << ids.messages;
  const auto mean = load_text(graph_with(R"("b": {"type": "mean", "in": {"images": ["color", "depth"]}})"));
  EXPECT_FALSE(mean.graph);
  EXPECT_NE(mean.messages.find("both must have one type"), std::string::npos) << mean.messages;
}

TEST(Graph, TenThousandNodesLoad) {
  std::string body;
  for (int i = 0; i < 10000; ++i)
    body += fmt::format(R"("n{}": {{"type": "gaussian", "in": {{"image": "{}"}}}},)", i,
                        i == 0  ? "color"
                        : i % 3 ? fmt::format("n{}", i - 1)
                                : fmt::format("n{}", i / 2));
  const auto l = load_text(graph_with(body + R"("b": {"type": "outlier_clamp", "in": {"image": "n9999"}})"));
  ASSERT_TRUE(l.graph);
  EXPECT_GT(l.graph->nodes.size(), 10u);
}

TEST(Graph, AChainOfNearlyAHundredThousandNodesDoesNotOverflowTheStack) {
  // Backwards, so that the walk must go to the end before it can finish the first.
  constexpr int n = 99'990;
  std::string body = R"("b": {"type": "outlier_clamp", "in": {"image": "n0"}})";
  for (int i = 0; i < n; ++i)
    body += fmt::format(R"(,"n{}": {{"type": "outlier_clamp", "in": {{"image": "{}"}}{}}})", i,
                        i + 1 == n ? "color" : fmt::format("n{}", i + 1), i % 2 ? R"(, "bypass": true)" : "");
  const auto l = load_text(graph_with(body));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes.size(), std::size_t(n / 2 + 1));
  EXPECT_EQ(l.graph->nodes.back().name, "b");
}

TEST(Graph, ManyErrorsAreCutShort) {
  std::string body = R"("b": {"type": "outlier_clamp", "in": {"image": "color"}})";
  for (int i = 0; i < 5000; ++i)
    body += fmt::format(R"(,"n{}": {{"type": "gaussian", "in": {{"image": "m{}"}}}})", i, i);
  const auto l = load_text(graph_with(body));
  EXPECT_FALSE(l.graph);
  EXPECT_NE(l.messages.find("more than 100 errors"), l.messages.npos);
  EXPECT_LT(l.messages.size(), 100'000u);
}

TEST(Graph, FingerprintsSeeWhatMatters) {
  const auto plain = load_svgf(), set = load_svgf({{Kind::set, "alpha=0.3"}}), tap = load_svgf({{Kind::tap, "blend"}}),
             wire = load_svgf({{Kind::wire, "history.image=level1.image@-1"}});
  EXPECT_EQ(fingerprint(*plain.graph), fingerprint(*load_svgf().graph));
  EXPECT_EQ(fingerprint(*plain.graph).size(), 16u);
  EXPECT_NE(fingerprint(*plain.graph), fingerprint(*set.graph));
  EXPECT_NE(fingerprint(*plain.graph), fingerprint(*wire.graph));
  EXPECT_EQ(fingerprint(*plain.graph), fingerprint(*tap.graph)) << "a tap shows what is computed anyway";
}

}  // namespace
}  // namespace quell::test
