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

std::string svgf_file() { return std::string(QUELL_TEST_SOURCE) + "/tests/core/graphs/svgf.json"; }
LoadedGraph load_svgf(std::vector<Edit> edits = {}) {
  GraphRequest request;
  request.graph = svgf_file();
  request.edits = std::move(edits);
  return load(std::move(request));
}
const GraphNode& node(const Graph& g, std::string_view name) {
  for (const auto& n : g.nodes)
    if (n.name == name) return n;
  throw std::runtime_error("no node " + std::string(name));
}
// The line of shown() that speaks of `name`.
std::string line(const LoadedGraph& l, const std::string& name) {
  if (!l.graph) return l.messages;
  const std::string all = "\n" + shown(*l.graph);
  const auto at = all.find("\n" + name + " ");
  return at == all.npos ? "" : all.substr(at + 1, all.find('\n', at + 1) - at - 1);
}
std::string nodes(std::string_view body, std::string_view outputs = "\"color\": \"b\"") {
  return fmt::format(
      R"({{"quell": 1, "inputs": {{"color": "radiance", "albedo": "albedo", "normal": "normal", "depth": "depth",
          "id": "id?", "motion": "motion"}}, "nodes": {{{}}}, "outputs": {{{}}}}})",
      body, outputs);
}

TEST(Graph, LoadsSvgf) {
  const auto l = load_svgf();
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.messages, "");
  EXPECT_EQ(l.graph->name, "SVGF");
  EXPECT_EQ(l.graph->nodes.size(), 30u);
  EXPECT_EQ(l.graph->nodes.front().name, "demodulate");
  EXPECT_EQ(l.graph->nodes.back().name, "modulate");
  EXPECT_EQ(line(l, "history"), "history <- image:level0.atrous.image@-1 motion:motion taps:surface.taps");
  EXPECT_EQ(line(l, "level1.atrous"),
            "level1.atrous <- image:level0.atrous.image variance:level0.atrous.variance weights:by_normal.weight "
            "weights:by_depth.weight weights:level1.by_luminance.weight");
  const auto& steady = node(*l.graph, "level3.steady");
  EXPECT_EQ(steady.instance.describe(), "kernel=binomial sigma=1 radius=1");
  EXPECT_EQ(steady.out_types, std::vector<int>{QUELL_VARIANCE});
  EXPECT_EQ(node(*l.graph, "moments_history").out_types, std::vector<int>{QUELL_MOMENTS});
  EXPECT_EQ(node(*l.graph, "history").out_types, std::vector<int>{QUELL_RADIANCE});
  EXPECT_EQ(node(*l.graph, "level4.atrous").instance.get_int(0), 16);
  EXPECT_EQ(node(*l.graph, "level0.atrous").position.source, 1) << "it stands in the subgraph's file";
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

TEST(Edits, SetReachesEveryDepth) {
  const auto l = load_svgf({{Kind::set, "alpha=0.3"},
                            {Kind::set, "level2.step=7"},
                            {Kind::set, "level1.atrous.step=5"},
                            {Kind::set, "level0.steady.kernel=box"},
                            {Kind::set, "sigma_luminance=2"},
                            {Kind::set, "blend.warm_up=false"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node(*l.graph, "blend").instance.describe(), "alpha=0.3 warm_up=false");
  EXPECT_EQ(node(*l.graph, "level2.atrous").instance.get_int(0), 7);
  EXPECT_EQ(node(*l.graph, "level1.atrous").instance.get_int(0), 5);
  EXPECT_EQ(node(*l.graph, "level0.steady").instance.describe(), "kernel=box sigma=1 radius=1");
  EXPECT_EQ(node(*l.graph, "level4.by_luminance").instance.get_float(0), 2.0f);
}

TEST(Edits, TheLastOfTwoHolds) {
  const auto l = load_svgf({{Kind::set, "level1.step=5"}, {Kind::set, "level1.step=6"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node(*l.graph, "level1.atrous").instance.get_int(0), 6);
}

TEST(Edits, WireMovesTheFeedback) {
  const auto l = load_svgf({{Kind::wire, "history.image=level1.image@-1"}});
  EXPECT_EQ(line(l, "history"), "history <- image:level1.atrous.image@-1 motion:motion taps:surface.taps");
  const auto start = load_svgf({{Kind::wire, R"(history.image={"from": "level1.image@-1", "start": "demodulate"})"}});
  EXPECT_EQ(line(start, "history"),
            "history <- image:level1.atrous.image@-1|demodulate.image motion:motion taps:surface.taps");
  const auto inner = load_svgf({{Kind::wire, "level0.by_luminance.image=blend"}});
  EXPECT_EQ(line(inner, "level0.by_luminance"),
            "level0.by_luminance <- image:blend.image variance:level0.steady.image");
  const auto list = load_svgf({{Kind::wire, "level0.weights=by_normal,by_depth_wide"}});
  EXPECT_EQ(line(list, "level0.atrous"),
            "level0.atrous <- image:variance.image variance:variance.variance weights:by_normal.weight "
            "weights:by_depth_wide.weight weights:level0.by_luminance.weight");
  const auto none = load_svgf({{Kind::wire, "surface.slope=null"}});
  EXPECT_EQ(line(none, "surface"),
            "surface <- motion:motion depth:depth depth_before:depth@-1 normal:normal normal_before:normal@-1 id:id "
            "id_before:id@-1");
}

TEST(Edits, BypassGivesWhatTheNodePasses) {
  const auto l = load_svgf({{Kind::bypass, "blend"}});
  EXPECT_EQ(line(l, "by_luminance"), "by_luminance <- image:demodulate.image");
  EXPECT_EQ(line(l, "blend"), "");
  EXPECT_NE(l.messages.find("warning: history: no output needs node 'history'"), l.messages.npos);
}

TEST(Edits, BypassedWeightsLeaveTheirLists) {
  const auto l = load_svgf({{Kind::bypass, "by_normal"}, {Kind::bypass, "level1.by_luminance"}});
  EXPECT_EQ(line(l, "level1.atrous"),
            "level1.atrous <- image:level0.atrous.image variance:level0.atrous.variance weights:by_depth.weight");
  EXPECT_EQ(line(l, "by_normal"), "");
}

TEST(Edits, ABypassedGraphPassesTheInputOfTheSameName) {
  const auto l = load_svgf({{Kind::bypass, "level1"}});
  EXPECT_EQ(line(l, "level2.steady"), "level2.steady <- image:level0.atrous.variance");
  ASSERT_TRUE(l.graph);
  EXPECT_EQ(l.graph->nodes.size(), 27u);
  EXPECT_EQ(l.messages, "");
}

TEST(Edits, SwapKeepsWhatFitsAndTakesRolesByName) {
  const auto l = load_svgf({{Kind::swap, "by_normal=plane_weight"}, {Kind::set, "by_normal.sigma=0.5"}});
  EXPECT_EQ(line(l, "by_normal"), "by_normal <- normal:normal position:position");
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node(*l.graph, "by_normal").instance.describe(), "sigma=0.5");
  EXPECT_EQ(l.graph->inputs.back().name, "position");
  EXPECT_EQ(l.graph->inputs.back().type, QUELL_POSITION);
  EXPECT_EQ(l.messages, "") << "that $power feeds nothing any more is the swap's doing";
}

TEST(Edits, SwapAsksTheSequence) {
  GraphRequest request;
  request.graph = svgf_file();
  request.edits = {{Kind::swap, "by_normal=plane_weight"}};
  request.roles = Roles{};
  for (const auto* name : {"color", "albedo", "normal", "depth", "motion"})
    (*request.roles)[name] = conventional_role(name);
  const auto l = load(request);
  EXPECT_FALSE(l.graph);
  EXPECT_EQ(l.messages,
            "--swap #1: error: by_normal: 'plane_weight' needs 'position', which nothing provides\n"
            "  its inputs: normal (normal), position (position)\n"
            "  wire it: by_normal.position = node.port\n");
}

TEST(Edits, SwapOfAGraphForANode) {
  const auto l = load_svgf({{Kind::swap, "level4=atrous"}, {Kind::set, "level4.step=3"}});
  EXPECT_EQ(line(l, "level4"),
            "level4 <- image:level3.atrous.image variance:level3.atrous.variance weights:by_normal.weight "
            "weights:by_depth.weight");
  EXPECT_EQ(line(l, "modulate"), "modulate <- image:level4.image albedo:albedo");
}

TEST(Edits, TapsAreOutputsToo) {
  const auto l = load_svgf({{Kind::tap, "blend.image"}, {Kind::tap, "level0.atrous.variance"}});
  ASSERT_TRUE(l.graph) << l.messages;
  ASSERT_EQ(l.graph->outputs.size(), 3u);
  EXPECT_EQ(l.graph->outputs[1].name, "blend.image");
  EXPECT_TRUE(l.graph->outputs[1].tap);
  EXPECT_EQ(l.graph->outputs[1].type, QUELL_RADIANCE);
  EXPECT_EQ(l.graph->outputs[2].type, QUELL_VARIANCE);
}

TEST(Edits, TextThatIsNoJsonIsText) {
  const auto l =
      load_text(nodes(R"("b": {"type": "grade", "in": {"image": "color"}, "set": {"lift": [0, 0.5, 0]}})"),
                {{Kind::set, "b.look=warm light"}, {Kind::set, "b.lift=[0.25,0,-1]"}, {Kind::set, "b.level=1e1"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[0].instance.describe(), "lift=[0.25,0,-1] look=\"warm light\" table=\"\" level=10");
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
  const auto l = load_text(nodes(R"("b": {"type": "grade", "in": {"image": "color"}})"),
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
  EXPECT_EQ(line(l, "surface"),
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
  const auto l = load_text(nodes(R"(
      "a": {"type": "atrous", "in": {"image": "color"}},
      "c": {"type": "atrous", "in": {"image": "a.image", "variance": "a.variance"}},
      "b": {"type": "atrous", "in": {"image": "c.image", "variance": "c.variance"}})",
                                 "\"color\": \"b.image\""));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(shown(*l.graph), "a <- image:color\nc <- image:a.image\nb <- image:c.image\ncolor = b.image\n");
}

TEST(Graph, DelaysAddUpThroughBypassedNodes) {
  const auto l = load_text(nodes(R"(
      "a": {"type": "outlier_clamp", "in": {"image": "color@-2"}, "bypass": true},
      "b": {"type": "modulate", "in": {"image": "a@-1", "albedo": "albedo"}})"));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(shown(*l.graph), "b <- image:color@-3 albedo:albedo\ncolor = b.image\n");
}

TEST(Graph, CastsAreExplicit) {
  const auto l = load_text(nodes(R"(
      "b": {"type": "outlier_clamp", "in": {"image": {"from": "normal", "as": "radiance"}}},
      "c": {"type": "gaussian", "in": {"image": {"from": "depth@-1", "as": "scalar"}}})",
                                 R"("color": "b", "s": "c", "n": {"from": "normal", "as": "albedo"})"));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[1].out_types[0], QUELL_SCALAR);
  EXPECT_EQ(l.graph->outputs[2].type, QUELL_ALBEDO);
}

TEST(Graph, TypeVariablesAreBoundThroughLoops) {
  // The blend's history comes from itself; its current frame tells the type of both.
  const auto l = load_text(nodes(R"(
      "n": {"type": "history_length", "in": {"before": "n@-1", "motion": "motion", "taps": "t"}},
      "t": {"type": "disocclusion", "in": {"motion": "motion"}},
      "r": {"type": "reproject", "in": {"image": "b@-1", "motion": "motion", "taps": "t"}},
      "b": {"type": "temporal_blend", "in": {"history": "r", "current": "normal", "count": "n"}})"));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node(*l.graph, "r").out_types[0], QUELL_NORMAL);
  EXPECT_EQ(l.graph->outputs[0].type, QUELL_NORMAL);
}

// Where no output is of type any, nothing binds the images of a list to one type.
TEST(Graph, ImagesOfAListMayEachHaveTheirType) {
  const auto packed = load_text(nodes(R"("b": {"type": "pack", "in": {"images": ["color", "depth", "normal@-1"]}})"));
  ASSERT_TRUE(packed.graph) << packed.messages;
  EXPECT_EQ(packed.graph->outputs[0].type, QUELL_FEATURES);
  const auto ids = load_text(nodes(R"("b": {"type": "pack", "in": {"images": ["color", "id"]}})"));
  EXPECT_FALSE(ids.graph);
  EXPECT_NE(ids.messages.find("b.in.images[1]: 'id' is id, but 'images' takes an image of numbers"), std::string::npos)
      << ids.messages;
  const auto mean = load_text(nodes(R"("b": {"type": "mean", "in": {"images": ["color", "depth"]}})"));
  EXPECT_FALSE(mean.graph);
  EXPECT_NE(mean.messages.find("both must have one type"), std::string::npos) << mean.messages;
}

class Files : public testing::Test {
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

TEST_F(Files, VariantsLieOverTheirBases) {
  write("base.json", nodes(R"(
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

TEST_F(Files, AStudyLaysOneMoreVariantOver) {
  write("base.json", nodes(R"("b": {"type": "gaussian", "in": {"image": "color"}, "set": {"sigma": 2}})"));
  GraphRequest request;
  request.graph = scratch_.path("base.json");
  Diagnostics quiet;
  request.laid_over =
      parse_json("study.json", R"({"set": {"b.sigma": 5}, "nodes": {"b": {"set": {"radius": 9}}}})", quiet);
  const auto l = load(request);
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[0].instance.describe(), "kernel=gaussian sigma=5 radius=9");
}

TEST_F(Files, EachUseOfASubgraphHasItsOwnHistory) {
  write("parts/smooth.json", R"({"quell": 1, "inputs": {"x": "any", "extra": "radiance?"}, "params": {"s": 1.5},
      "nodes": {"blur": {"type": "gaussian", "in": {"image": "x@-1"}, "set": {"sigma": "$s"}}}, "outputs": {"x": "blur"}})");
  write("g.json", nodes(R"(
      "p": {"graph": "parts/smooth.json", "in": {"x": "color"}},
      "q": {"graph": "parts/smooth.json", "in": {"x": "p@-1"}, "set": {"s": 4}},
      "b": {"type": "outlier_clamp", "in": {"image": "q"}})"));
  const auto l = load_file("g.json", {{Kind::tap, "p.blur"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(shown(*l.graph),
            "p.blur <- image:color@-1\nq.blur <- image:p.blur.image@-2\nb <- image:q.blur.image\n"
            "color = b.image\ntap p.blur = p.blur.image\n");
  EXPECT_EQ(node(*l.graph, "q.blur").instance.get_float(1), 4.0f);
}

TEST_F(Files, AFileCalledLikeAnOptionIsNotTrustedLikeOne) {
  write("--set #1", R"({"quell": 1, "inputs": {"x": "radiance"}, "nodes": {
      "g": {"type": "grade", "in": {"image": "x"}, "set": {"table": "/etc/hostname"}}}, "outputs": {"x": "g"}})");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(scratch_.folder());
  const auto l = load_text(nodes(R"("b": {"graph": "--set #1", "in": {"x": "color"}})"));
  std::filesystem::current_path(before);
  EXPECT_FALSE(l.graph);
  EXPECT_TRUE(l.messages.starts_with(
      "./--set #1:2:69: error: b.g.set.table: a graph names no files, as \"/etc/hostname\" does\n"))
      << l.messages;
}

TEST_F(Files, ListsAreSpliced) {
  write("parts/filter.json", R"({"quell": 1, "inputs": {"image": "radiance", "w": "weight[]", "normal": "normal"},
      "nodes": {"own": {"type": "normal_weight", "in": {"normal": "normal"}},
                "f": {"type": "atrous", "in": {"image": "image", "weights": ["w", "own", "w"]}}},
      "outputs": {"image": "f.image"}})");
  write("g.json", nodes(R"(
      "n": {"type": "normal_weight", "in": {"normal": "normal"}}, "d": {"type": "depth_weight", "in": {"depth": "depth"}},
      "b": {"graph": "parts/filter.json", "in": {"image": "color", "normal": "normal", "w": ["n", "d"]}},
      "e": {"graph": "parts/filter.json", "in": {"image": "color", "normal": "normal"}})",
                        R"("color": "b", "e": "e")"));
  const auto l = load_file("g.json");
  EXPECT_EQ(line(l, "b.f"),
            "b.f <- image:color weights:n.weight weights:d.weight weights:b.own.weight weights:n.weight "
            "weights:d.weight");
  EXPECT_EQ(line(l, "e.f"), "e.f <- image:color weights:e.own.weight");
}

TEST(Graph, TenThousandNodesLoad) {
  std::string body;
  for (int i = 0; i < 10000; ++i)
    body += fmt::format(R"("n{}": {{"type": "gaussian", "in": {{"image": "{}"}}}},)", i,
                        i == 0  ? "color"
                        : i % 3 ? fmt::format("n{}", i - 1)
                                : fmt::format("n{}", i / 2));
  const auto l = load_text(nodes(body + R"("b": {"type": "outlier_clamp", "in": {"image": "n9999"}})"));
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
  const auto l = load_text(nodes(body));
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes.size(), std::size_t(n / 2 + 1));
  EXPECT_EQ(l.graph->nodes.back().name, "b");
}

TEST_F(Files, ExpansionIsBounded) {
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

TEST_F(Files, SplicedListsAreBounded) {
  write("p0.json", R"({"quell": 1, "inputs": {"x": "radiance", "w": "weight[]"},
      "nodes": {"f": {"type": "atrous", "in": {"image": "x", "weights": ["w", "w"]}}}, "outputs": {"x": "f.image"}})");
  for (int level = 1; level <= 20; ++level)
    write(fmt::format("p{}.json", level),
          fmt::format(R"({{"quell": 1, "inputs": {{"x": "radiance", "w": "weight[]"}}, "nodes": {{
              "n": {{"graph": "p{}.json", "in": {{"x": "x", "w": ["w", "w"]}}}}}}, "outputs": {{"x": "n"}}}})",
                      level - 1));
  write("g.json", nodes(R"("d": {"type": "depth_weight", "in": {"depth": "depth"}},
      "b": {"graph": "p20.json", "in": {"x": "color", "w": ["d", "d"]}})"));
  const auto l = load_file("g.json");
  EXPECT_FALSE(l.graph);
  EXPECT_NE(l.messages.find("more than 1024 wires in one list"), l.messages.npos) << l.messages;
}

TEST(Graph, ManyErrorsAreCutShort) {
  std::string body = R"("b": {"type": "outlier_clamp", "in": {"image": "color"}})";
  for (int i = 0; i < 5000; ++i)
    body += fmt::format(R"(,"n{}": {{"type": "gaussian", "in": {{"image": "m{}"}}}})", i, i);
  const auto l = load_text(nodes(body));
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
