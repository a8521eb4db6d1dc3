// Graphs of several files: variants and their bases, subgraphs, and how large they may grow.
#include "tests/support/graph_nodes.h"
#include "tests/support/scratch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

namespace quell::test {
namespace {

using Kind = Edit::Kind;

class GraphFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(scratch_.path(name)).parent_path());
    std::ofstream(scratch_.path(name)) << text;
    return scratch_.path(name);
  }
  LoadedGraph load_file(const std::string& name, std::vector<Edit> edits = {}) {
    GraphRequest request;
    request.graph = scratch_.path(name);
    request.edits = std::move(edits);
    return load(request);
  }
  Scratch scratch_;
};

TEST_F(GraphFiles, VariantsLieOverTheirBases) {
  write("base.json", graph_with(R"(
      "c": {"type": "outlier_clamp", "in": {"image": "color"}, "set": {"k": 3}},
      "g": {"type": "gaussian", "in": {"image": "c"}, "set": {"sigma": 2, "radius": 5}},
      "b": {"type": "modulate", "in": {"image": "g", "albedo": "albedo"}})"));
  write("middle.json", R"({"quell": 1, "base": "base.json", "name": "M",
      "nodes": {"g": {"set": {"sigma": null, "radius": 7}}, "c": null},
      "wire": {"g.image": "color"}})");
  write("top.json", R"({"quell": 1, "base": "middle.json", "swap": {"b": "outlier_clamp"},
      "set": {"g.kernel": "box"}, "outputs": {"extra": "g"}})");
  const auto l = load_file("top.json");
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->name, "M");
  EXPECT_EQ(shown(*l.graph), "g <- image:color\nb <- image:g.image\ncolor = b.image\nextra = g.image\n");
  EXPECT_EQ(l.graph->nodes[0].instance.describe(), "kernel=box sigma=1 radius=7");
}

TEST_F(GraphFiles, AStudyLaysOneMoreVariantOver) {
  write("base.json", graph_with(R"("b": {"type": "gaussian", "in": {"image": "color"}, "set": {"sigma": 2}})"));
  GraphRequest request;
  request.graph = scratch_.path("base.json");
  Diagnostics quiet;
  request.laid_over =
      parse_json("study.json", R"({"set": {"b.sigma": 5}, "nodes": {"b": {"set": {"radius": 9}}}})", quiet);
  const auto l = load(request);
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[0].instance.describe(), "kernel=gaussian sigma=5 radius=9");
}

TEST_F(GraphFiles, EachUseOfASubgraphHasItsOwnHistory) {
  write("parts/smooth.json", R"({"quell": 1, "inputs": {"x": "any", "extra": "radiance?"}, "params": {"s": 1.5},
      "nodes": {"blur": {"type": "gaussian", "in": {"image": "x@-1"}, "set": {"sigma": "$s"}}}, "outputs": {"x": "blur"}})");
  write("g.json", graph_with(R"(
      "p": {"graph": "parts/smooth.json", "in": {"x": "color"}},
      "q": {"graph": "parts/smooth.json", "in": {"x": "p@-1"}, "set": {"s": 4}},
      "b": {"type": "outlier_clamp", "in": {"image": "q"}})"));
  const auto l = load_file("g.json", {{Kind::tap, "p.blur"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(shown(*l.graph),
            "p.blur <- image:color@-1\nq.blur <- image:p.blur.image@-2\nb <- image:q.blur.image\n"
            "color = b.image\ntap p.blur = p.blur.image\n");
  EXPECT_EQ(node_called(*l.graph, "q.blur").instance.get_float(1), 4.0f);
}

TEST_F(GraphFiles, AFileCalledLikeAnOptionIsNotTrustedLikeOne) {
  write("--set #1", R"({"quell": 1, "inputs": {"x": "radiance"}, "nodes": {
      "g": {"type": "grade", "in": {"image": "x"}, "set": {"table": "/etc/hostname"}}}, "outputs": {"x": "g"}})");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(scratch_.folder());
  const auto l = load_text(graph_with(R"("b": {"graph": "--set #1", "in": {"x": "color"}})"));
  std::filesystem::current_path(before);
  EXPECT_FALSE(l.graph);
  EXPECT_TRUE(l.messages.starts_with(
      "./--set #1:2:69: error: b.g.set.table: a graph names no files, as \"/etc/hostname\" does\n"))
      << l.messages;
}

TEST_F(GraphFiles, ListsAreSpliced) {
  write("parts/filter.json", R"({"quell": 1, "inputs": {"image": "radiance", "w": "weight[]", "normal": "normal"},
      "nodes": {"own": {"type": "normal_weight", "in": {"normal": "normal"}},
                "f": {"type": "atrous", "in": {"image": "image", "weights": ["w", "own", "w"]}}},
      "outputs": {"image": "f.image"}})");
  write("g.json", graph_with(R"(
      "n": {"type": "normal_weight", "in": {"normal": "normal"}}, "d": {"type": "depth_weight", "in": {"depth": "depth"}},
      "b": {"graph": "parts/filter.json", "in": {"image": "color", "normal": "normal", "w": ["n", "d"]}},
      "e": {"graph": "parts/filter.json", "in": {"image": "color", "normal": "normal"}})",
                             R"("color": "b", "e": "e")"));
  const auto l = load_file("g.json");
  EXPECT_EQ(line_of(l, "b.f"),
            "b.f <- image:color weights:n.weight weights:d.weight weights:b.own.weight weights:n.weight "
            "weights:d.weight");
  EXPECT_EQ(line_of(l, "e.f"), "e.f <- image:color weights:e.own.weight");
}

TEST_F(GraphFiles, ExpansionIsBounded) {
  // Ten to the power of six nodes from seven small files.
  write("p0.json", R"({"quell": 1, "inputs": {"x": "radiance"},
      "nodes": {"a": {"type": "outlier_clamp", "in": {"image": "x"}}}, "outputs": {"x": "a"}})");
  for (int level = 1; level <= 6; ++level) {
    std::string body;
    for (int i = 0; i < 10; ++i)
      body += fmt::format(R"({}"n{}": {{"graph": "p{}.json", "in": {{"x": "x"}}}})", i ? ", " : "", i, level - 1);
    write(fmt::format("p{}.json", level),
          fmt::format(R"({{"quell": 1, "inputs": {{"x": "radiance"}}, "nodes": {{{}}}, "outputs": {{"x": "n0"}}}})",
                      body));
  }
  const auto l = load_file("p6.json");
  EXPECT_FALSE(l.graph);
  EXPECT_EQ(l.messages, scratch_.path("p6.json") + ":1:1: error: more than 100000 nodes\n");
}

TEST_F(GraphFiles, SplicedListsAreBounded) {
  write("p0.json", R"({"quell": 1, "inputs": {"x": "radiance", "w": "weight[]"},
      "nodes": {"f": {"type": "atrous", "in": {"image": "x", "weights": ["w", "w"]}}}, "outputs": {"x": "f.image"}})");
  for (int level = 1; level <= 20; ++level)
    write(fmt::format("p{}.json", level),
          fmt::format(R"({{"quell": 1, "inputs": {{"x": "radiance", "w": "weight[]"}}, "nodes": {{
              "n": {{"graph": "p{}.json", "in": {{"x": "x", "w": ["w", "w"]}}}}}}, "outputs": {{"x": "n"}}}})",
                      level - 1));
  write("g.json", graph_with(R"("d": {"type": "depth_weight", "in": {"depth": "depth"}},
      "b": {"graph": "p20.json", "in": {"x": "color", "w": ["d", "d"]}})"));
  const auto l = load_file("g.json");
  EXPECT_FALSE(l.graph);
  EXPECT_NE(l.messages.find("more than 1024 wires in one list"), l.messages.npos) << l.messages;
}

}  // namespace
}  // namespace quell::test
