// Graphs with edits laid over: set, swap, wire, bypass and tap.
#include "tests/support/graph_nodes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quell::test {
namespace {

using Kind = Edit::Kind;

TEST(Edits, SetReachesEveryDepth) {
  const auto l = load_svgf({{Kind::set, "alpha=0.3"},
                            {Kind::set, "level2.step=7"},
                            {Kind::set, "level1.atrous.step=5"},
                            {Kind::set, "level0.steady.kernel=box"},
                            {Kind::set, "sigma_luminance=2"},
                            {Kind::set, "blend.warm_up=false"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node_called(*l.graph, "blend").instance.describe(), "alpha=0.3 warm_up=false");
  EXPECT_EQ(node_called(*l.graph, "level2.atrous").instance.get_int(0), 7);
  EXPECT_EQ(node_called(*l.graph, "level1.atrous").instance.get_int(0), 5);
  EXPECT_EQ(node_called(*l.graph, "level0.steady").instance.describe(), "kernel=box sigma=1 radius=1");
  EXPECT_EQ(node_called(*l.graph, "level4.by_luminance").instance.get_float(0), 2.0f);
}

TEST(Edits, TheLastOfTwoHolds) {
  const auto l = load_svgf({{Kind::set, "level1.step=5"}, {Kind::set, "level1.step=6"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node_called(*l.graph, "level1.atrous").instance.get_int(0), 6);
}

TEST(Edits, WireMovesTheFeedback) {
  const auto l = load_svgf({{Kind::wire, "history.image=level1.image@-1"}});
  EXPECT_EQ(line_of(l, "history"), "history <- image:level1.atrous.image@-1 motion:motion taps:surface.taps");
  const auto start = load_svgf({{Kind::wire, R"(history.image={"from": "level1.image@-1", "start": "demodulate"})"}});
  EXPECT_EQ(line_of(start, "history"),
            "history <- image:level1.atrous.image@-1|demodulate.image motion:motion taps:surface.taps");
  const auto inner = load_svgf({{Kind::wire, "level0.by_luminance.image=blend"}});
  EXPECT_EQ(line_of(inner, "level0.by_luminance"),
            "level0.by_luminance <- image:blend.image variance:level0.steady.image");
  const auto list = load_svgf({{Kind::wire, "level0.weights=by_normal,by_depth_wide"}});
  EXPECT_EQ(line_of(list, "level0.atrous"),
            "level0.atrous <- image:variance.image variance:variance.variance weights:by_normal.weight "
            "weights:by_depth_wide.weight weights:level0.by_luminance.weight");
  const auto none = load_svgf({{Kind::wire, "surface.slope=null"}});
  EXPECT_EQ(line_of(none, "surface"),
            "surface <- motion:motion depth:depth depth_before:depth@-1 normal:normal normal_before:normal@-1 id:id "
            "id_before:id@-1");
}

TEST(Edits, BypassGivesWhatTheNodePasses) {
  const auto l = load_svgf({{Kind::bypass, "blend"}});
  EXPECT_EQ(line_of(l, "by_luminance"), "by_luminance <- image:demodulate.image");
  EXPECT_EQ(line_of(l, "blend"), "");
  EXPECT_NE(l.messages.find("warning: history: no output needs node 'history'"), l.messages.npos);
}

TEST(Edits, BypassedWeightsLeaveTheirLists) {
  const auto l = load_svgf({{Kind::bypass, "by_normal"}, {Kind::bypass, "level1.by_luminance"}});
  EXPECT_EQ(line_of(l, "level1.atrous"),
            "level1.atrous <- image:level0.atrous.image variance:level0.atrous.variance weights:by_depth.weight");
  EXPECT_EQ(line_of(l, "by_normal"), "");
}

TEST(Edits, ABypassedGraphPassesTheInputOfTheSameName) {
  const auto l = load_svgf({{Kind::bypass, "level1"}});
  EXPECT_EQ(line_of(l, "level2.steady"), "level2.steady <- image:level0.atrous.variance");
  ASSERT_TRUE(l.graph);
  EXPECT_EQ(l.graph->nodes.size(), 27u);
  EXPECT_EQ(l.messages, "");
}

TEST(Edits, SwapKeepsWhatFitsAndTakesRolesByName) {
  const auto l = load_svgf({{Kind::swap, "by_normal=plane_weight"}, {Kind::set, "by_normal.sigma=0.5"}});
  EXPECT_EQ(line_of(l, "by_normal"), "by_normal <- normal:normal position:position");
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(node_called(*l.graph, "by_normal").instance.describe(), "sigma=0.5");
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
  EXPECT_EQ(line_of(l, "level4"),
            "level4 <- image:level3.atrous.image variance:level3.atrous.variance weights:by_normal.weight "
            "weights:by_depth.weight");
  EXPECT_EQ(line_of(l, "modulate"), "modulate <- image:level4.image albedo:albedo");
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
      load_text(graph_with(R"("b": {"type": "grade", "in": {"image": "color"}, "set": {"lift": [0, 0.5, 0]}})"),
                {{Kind::set, "b.look=warm light"}, {Kind::set, "b.lift=[0.25,0,-1]"}, {Kind::set, "b.level=1e1"}});
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(l.graph->nodes[0].instance.describe(), "lift=[0.25,0,-1] look=\"warm light\" table=\"\" level=10");
}

}  // namespace
}  // namespace quell::test
