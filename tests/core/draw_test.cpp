// Drawings: every node and wire is there, and boxes do not lie on each other.
#include "core/graph/draw.h"

#include "core/graph/drawing.h"
#include "tests/support/graph_nodes.h"
#include "tests/support/paths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

Graph svgf() {
  GraphRequest request;
  request.graph = std::string(QUELL_TEST_SOURCE) + "/tests/core/graphs/svgf.json";
  return *load(request).graph;
}
std::size_t count(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Draw, Dot) {
  const auto l =
      load_text(R"({"quell": 1, "name": "A \"graph\"", "inputs": {"color": "radiance", "normal": "normal"}, "nodes": {
      "w": {"type": "normal_weight", "in": {"normal": "normal"}},
      "b": {"type": "atrous", "in": {"image": {"from": "b.image@-2", "start": "color"}, "weights": "w"}}},
      "outputs": {"color": "b.image"}})");
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(draw_dot(*l.graph),
            "digraph \"A \\\"graph\\\"\" {\n"
            "  node [shape=box, fontname=\"sans-serif\"];\n"
            "  edge [fontname=\"sans-serif\", fontsize=9];\n"
            "  n0 [label=\"color\\nradiance\", tooltip=\"\", style=rounded, color=\"#2b6cb0\"];\n"
            "  n1 [label=\"normal\\nnormal\", tooltip=\"\", style=rounded, color=\"#2b6cb0\"];\n"
            "  n2 [label=\"w\\nnormal_weight\", tooltip=\"mode=power power=128 sigma=0.1\", color=\"#c05621\"];\n"
            "  n3 [label=\"b\\natrous\", tooltip=\"step=1\"];\n"
            "  n4 [label=\"color\\nradiance\", tooltip=\"\", style=rounded, color=\"#2f855a\"];\n"
            "  n1 -> n2 [label=\"normal\"];\n"
            "  n3 -> n3 [label=\"image → image @-2\", style=dashed, constraint=false];\n"
            "  n0 -> n3 [label=\"image at the start\", style=dotted];\n"
            "  n2 -> n3 [label=\"weight → weights\", color=\"#c05621\"];\n"
            "  n3 -> n4 [label=\"image → color\"];\n"
            "}\n");
  EXPECT_EQ(draw_mermaid(*l.graph),
            "flowchart TD\n"
            "  n0([\"color<br/><small>radiance</small>\"])\n"
            "  n1([\"normal<br/><small>normal</small>\"])\n"
            "  n2[\"w<br/><small>normal_weight</small>\"]\n"
            "  n3[\"b<br/><small>atrous</small>\"]\n"
            "  n4([\"color<br/><small>radiance</small>\"])\n"
            "  n1 -->|\"normal\"| n2\n"
            "  n3 -.->|\"image → image @-2\"| n3\n"
            "  n0 -.->|\"image at the start\"| n3\n"
            "  n2 -->|\"weight → weights\"| n3\n"
            "  n3 -->|\"image → color\"| n4\n"
            "  linkStyle 3 stroke:#c05621\n");
}

TEST(Draw, SvgHoldsEveryNodeAndWire) {
  const Graph g = svgf();
  const Boxes boxes = boxes_of(g);
  const std::string svg = draw_svg(g);
  EXPECT_EQ(count(svg, "<rect "), boxes.boxes.size() + 1);  // and the background
  EXPECT_EQ(count(svg, "marker-end="), boxes.lines.size());
  EXPECT_EQ(count(svg, "class=\"delayed\""), 6u);
  EXPECT_EQ(count(svg, "nan,") + count(svg, ",nan") + count(svg, "\"nan"), 0u);
  EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
  for (const auto& n : g.nodes) EXPECT_NE(svg.find(">" + n.name + "</text>"), svg.npos);
}

TEST(Draw, BoxesDoNotOverlapAndLinesLeadDown) {
  const Boxes boxes = boxes_of(svgf());
  const std::vector<double> widths(boxes.boxes.size(), 120.0);
  const Layout layout = lay_out(boxes, widths, 80);
  for (std::size_t i = 0; i < boxes.boxes.size(); ++i) {
    EXPECT_GE(layout.box[i].x, 60);
    EXPECT_LE(layout.box[i].x, layout.width - 60);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(layout.box[i].y != layout.box[j].y || std::abs(layout.box[i].x - layout.box[j].x) >= 120)
          << boxes.boxes[i].name << " and " << boxes.boxes[j].name;
  }
  for (std::size_t l = 0; l < boxes.lines.size(); ++l) {
    if (boxes.lines[l].delay) continue;
    for (std::size_t p = 1; p < layout.line[l].size(); ++p)
      EXPECT_EQ(layout.line[l][p].y, layout.line[l][p - 1].y + 80);
  }
}

TEST(Draw, TextIsEscaped) {
  auto l = load_text(R"({"quell": 1, "name": "<&>", "inputs": {"color": "radiance"}, "nodes": {
      "b": {"type": "grade", "in": {"image": "color"}, "set": {"look": "<script>\"x\""}}}, "outputs": {"color": "b"}})");
  ASSERT_TRUE(l.graph);
  const std::string svg = draw_svg(*l.graph);
  EXPECT_NE(svg.find("<title>&lt;&amp;&gt;</title>"), svg.npos);
  EXPECT_EQ(svg.find("<script>"), svg.npos);
}

TEST(Draw, LargeGraphsCanBeDrawn) {
  std::string body;
  for (int i = 0; i < 5000; ++i)
    body += fmt::format(R"({}"n{}": {{"type": "modulate", "in": {{"image": "{}", "albedo": "albedo"}}}})", i ? "," : "",
                        i, i ? fmt::format("n{}", i - 1) : "color");
  const auto l = load_text(R"({"quell": 1, "inputs": {"color": "radiance", "albedo": "albedo"}, "nodes": {)" + body +
                           R"(}, "outputs": {"color": "n4999"}})");
  ASSERT_TRUE(l.graph) << l.messages;
  EXPECT_EQ(count(draw_svg(*l.graph), "<rect "), 5004u);
}

}  // namespace
}  // namespace quell::test
