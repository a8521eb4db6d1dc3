// A resolved graph, written and loaded again, is the same graph.
#include "core/graph/write.h"
#include "core/graph/narrow.h"
#include "core/graph/preview.h"

#include "tests/support/graph_nodes.h"
#include "tests/support/paths.h"
#include "tests/support/scratch.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace quell::test {
namespace {

std::vector<std::vector<int>> types_of(const Graph& graph) {
  std::vector<std::vector<int>> types;
  for (const auto& n : graph.nodes) types.push_back(n.out_types);
  for (const auto& o : graph.outputs)
    if (!o.tap) types.push_back({o.type});
  return types;
}

WrittenGraph written(const Graph& graph) { return write_graph(graph, QUELL_TEST_SOURCE "/tests/core/graphs"); }

// Loads what was written of the graph; fails unless it is the same again.
LoadedGraph round_trip(const Graph& graph, std::vector<Edit> edits = {}) {
  const auto text = written(graph).text;
  auto again = load_text(text, std::move(edits));
  EXPECT_EQ(again.messages, "") << text;
  if (!again.graph) return again;
  EXPECT_EQ(fingerprint_text(*again.graph), fingerprint_text(graph)) << text;
  EXPECT_EQ(types_of(*again.graph), types_of(graph)) << text;
  EXPECT_EQ(again.graph->name, graph.name);
  EXPECT_EQ(again.graph->about, graph.about);
  EXPECT_EQ(written(*again.graph).text, text);
  return again;
}

Graph graph_of(const std::string& text, std::vector<Edit> edits = {}) {
  auto loaded = load_text(text, std::move(edits));
  if (!loaded.graph) throw std::runtime_error(loaded.messages);
  return std::move(*loaded.graph);
}

LoadedGraph svgf(std::vector<Edit> edits = {}) {
  GraphRequest request;
  request.graph = QUELL_TEST_SOURCE "/tests/core/graphs/svgf.json";
  request.edits = std::move(edits);
  return load(request);
}

TEST(WriteGraph, SvgfWithItsSubgraphsAndHistory) {
  const auto loaded = svgf();
  ASSERT_TRUE(loaded.graph) << loaded.messages;
  round_trip(*loaded.graph);
}

TEST(WriteGraph, NarrowedToOneOutput) {
  const auto loaded = svgf({{Edit::Kind::tap, "age.count"}});
  ASSERT_TRUE(loaded.graph) << loaded.messages;
  const auto tap =
      std::size_t(std::ranges::find(loaded.graph->outputs, true, &GraphOutput::tap) - loaded.graph->outputs.begin());
  ASSERT_LT(tap, loaded.graph->outputs.size());
  const auto graph = narrowed(*loaded.graph, tap, "frames");
  // Nothing is left that it does not need, or loading it would warn; nothing is missing that it does.
  round_trip(graph);
  ASSERT_EQ(graph.outputs.size(), 1u);
  EXPECT_EQ(graph.outputs[0].name, "frames");
  EXPECT_FALSE(graph.outputs[0].tap);
  EXPECT_LT(graph.nodes.size(), loaded.graph->nodes.size());
  EXPECT_LT(graph.inputs.size(), loaded.graph->inputs.size());
  EXPECT_TRUE(graph.looks_back());
  for (const auto& node : graph.nodes) {
    const auto same = std::ranges::find(loaded.graph->nodes, node.name, &GraphNode::name);
    ASSERT_NE(same, loaded.graph->nodes.end());
    EXPECT_EQ(node.instance.describe(), same->instance.describe());
  }
}

TEST(WriteGraph, WithEditsApplied) {
  using Kind = Edit::Kind;
  const auto loaded = svgf({{Kind::set, "level0.atrous.step=2"},
                            {Kind::set, "alpha=0.07"},
                            {Kind::swap, "by_normal=plane_weight"},
                            {Kind::wire, "history.image=level1.atrous.image@-1"},
                            {Kind::bypass, "level2.by_luminance"},
                            {Kind::tap, "blend.image"}});
  ASSERT_TRUE(loaded.graph) << loaded.messages;
  const auto text = written(*loaded.graph).text;
  EXPECT_NE(text.find("\"level0.atrous\": { \"type\": \"atrous\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"alpha\": 0.07"), std::string::npos) << "the shortest number that is the float: " << text;
  EXPECT_EQ(text.find("level2.by_luminance"), std::string::npos) << text;
  round_trip(*loaded.graph);
}

TEST(WriteGraph, EditsReachNodesByTheirDottedNames) {
  using Kind = Edit::Kind;
  const auto plain = svgf();
  ASSERT_TRUE(plain.graph) << plain.messages;
  for (const std::vector<Edit>& edits : {std::vector<Edit>{{Kind::set, "level0.atrous.step=3"}},
                                         {{Kind::swap, "level1.by_luminance=depth_weight"}},
                                         {{Kind::wire, "level0.atrous.weights=by_normal"}},
                                         {{Kind::bypass, "level0.by_luminance"}}}) {
    const auto edited = svgf(edits);
    const auto again = load_text(written(*plain.graph).text, edits);
    ASSERT_TRUE(edited.graph && again.graph) << edits[0].text << edited.messages << again.messages;
    EXPECT_EQ(fingerprint_text(*again.graph), fingerprint_text(*edited.graph)) << edits[0].text;
    EXPECT_NE(fingerprint(*again.graph), fingerprint(*plain.graph)) << edits[0].text;
  }
}

TEST(WriteGraph, CastsStartsAndLists) {
  round_trip(graph_of(R"({"quell": 1, "name": "a \"b\"", "about": "ü\n2",
    "inputs": {"color": "radiance", "depth": "depth"}, "nodes": {
    "n": {"type": "gaussian", "in": {"image": {"from": "color", "as": "features"}}},
    "c": {"type": "outlier_clamp", "in": {"image": {"from": "n.image", "as": "radiance"}}},
    "b": {"type": "gaussian", "in": {"image": {"from": "b.image@-2", "start": "c"}}},
    "p": {"type": "pack", "in": {"images": ["b", "depth", "n"]}}
  }, "outputs": {"color": "c", "all": "p", "was": "b@-1", "raw": {"from": "color", "as": "features"}}})"));
}

TEST(WriteGraph, ALoopWhoseTypeOnlyACastTells) {
  const auto graph = graph_of(R"({"quell": 1, "inputs": {}, "nodes": {
    "a": {"type": "gaussian", "in": {"image": {"from": "b@-1", "as": "radiance"}}},
    "b": {"type": "gaussian", "in": {"image": "a"}}
  }, "outputs": {"color": "b"}})");
  round_trip(graph);
}

TEST(WriteGraph, EveryKindOfParameter) {
  const Scratch scratch;
  const auto file = scratch.path("look.cube");
  std::ofstream(file) << "x";
  const std::string text = R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {
    "g": {"type": "grade", "in": {"image": "color"}, "set": {"lift": [0.1, -0.25, 1e-7], "look": "$$ \"a\"", "level": 3}},
    "blur": {"type": "gaussian", "in": {"image": "color"}, "set": {"kernel": "box", "sigma": 0.3}}
  }, "outputs": {"color": "g", "blurred": "blur"}})";
  round_trip(graph_of(text));

  const auto with_file = graph_of(text, {{Edit::Kind::set, "g.table=" + file}});
  const auto out = written(with_file);
  EXPECT_EQ(out.files, std::vector<std::string>{"g.table=" + file});
  EXPECT_EQ(out.text.find("look.cube"), std::string::npos) << "a graph file may name no file";
  const auto again = load_text(out.text, {{Edit::Kind::set, out.files[0]}});
  ASSERT_TRUE(again.graph) << again.messages;
  EXPECT_EQ(fingerprint_text(*again.graph), fingerprint_text(with_file));

  // The same file, installed with the graphs.
  const auto installed = write_graph(with_file, std::filesystem::path(file).parent_path());
  EXPECT_TRUE(installed.files.empty());
  EXPECT_NE(installed.text.find("\"table\": \"quell:look.cube\""), std::string::npos) << installed.text;
}

TEST(WriteGraph, LeavesPreviewsOut) {
  auto graph = graph_of(R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {
    "blur": {"type": "gaussian", "in": {"image": "color"}}}, "outputs": {"color": "blur"}})");
  const auto plain = written(graph).text;
  auto shown = graph_of(R"({"quell": 1, "inputs": {"image": "radiance"}, "nodes": {
    "g": {"type": "grade", "in": {"image": "image"}}}, "outputs": {"picture": "g"}})");
  add_preview(graph, 0, std::move(shown));
  EXPECT_EQ(written(graph).text, plain);
}

TEST(ReferenceText, NamesWhatAWireReads) {
  const auto loaded =
      svgf({{Edit::Kind::tap, "variance.image"}, {Edit::Kind::tap, "blend@-1"}, {Edit::Kind::tap, "depth"}});
  ASSERT_TRUE(loaded.graph) << loaded.messages;
  std::vector<std::string> names;
  for (const auto& o : loaded.graph->outputs)
    if (o.tap) names.push_back(reference_text(*loaded.graph, o.wire));
  EXPECT_EQ(names, (std::vector<std::string>{"variance.image", "blend@-1", "depth"}));
}

TEST(DottedNames, MustNotReadAsPortsOfOthers) {
  const auto nodes = [](const std::string& first, const std::string& second) {
    return load_text(R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {")" + first +
                     R"(": {"type": "gaussian", "in": {"image": "color"}}, ")" + second +
                     R"(": {"type": "gaussian", "in": {"image": "color"}}}, "outputs": {"a": ")" + first +
                     R"(.image", "b": ")" + second + R"("}})");
  };
  EXPECT_EQ(nodes("a.b", "a.c").messages, "");
  EXPECT_NE(nodes("a", "a.b").messages.find("a.b: 'a.b' cannot be a name beside 'a'\n  'a.b' would be a port of 'a'"),
            std::string::npos)
      << nodes("a", "a.b").messages;
  EXPECT_NE(nodes("a.b.c", "a.b").messages.find("'a.b.c' cannot be a name beside 'a.b'"), std::string::npos);
  EXPECT_NE(nodes("a", "color.x").messages.find("'color.x' cannot be a name beside 'color'"), std::string::npos);
  EXPECT_NE(nodes("a", "b..c").messages.find("'b..c' cannot be a name"), std::string::npos);
}

}  // namespace
}  // namespace quell::test
