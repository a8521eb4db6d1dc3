// Previews join a graph without becoming part of what it computes, and each type's preview takes that type.
#include "core/graph/preview.h"
#include "core/graph/load.h"
#include "core/report/error.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

#include <quell/types.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace quell::test {
namespace {

namespace fs = std::filesystem;

Graph load_from(GraphRequest request) {
  request.graphs = QUELL_TEST_SOURCE "/graphs";
  Diagnostics diagnostics;
  auto graph = load_graph(request, registry(), diagnostics);
  if (!graph) throw std::runtime_error(diagnostics.format());
  return std::move(*graph);
}
Graph load_text(const std::string& text) {
  GraphRequest request;
  request.graph = "text.json";
  request.text = text;
  return load_from(request);
}
Graph load_named(const std::string& name) {
  GraphRequest request;
  request.graph = name;
  return load_from(request);
}

// A graph that gives its input back.
Graph through(const std::string& type) {
  return load_text(R"({"quell": 1, "inputs": {"in": ")" + type + R"("}, "outputs": {"out": "in"}})");
}

TEST(Previews, EachFitsItsType) {
  int found = 0;
  for (const auto& file : fs::directory_iterator(QUELL_TEST_SOURCE "/graphs/previews")) {
    const auto name = file.path().stem().string();
    SCOPED_TRACE(name);
    auto graph = through(type_info(name) ? name : "radiance");
    add_preview(graph, 0, load_named(file.path().string()));
    ASSERT_EQ(graph.outputs.size(), 2u);
    EXPECT_EQ(graph.outputs[1].type, QUELL_DISPLAY);
    EXPECT_EQ(graph.outputs[1].shows, 0);
    ++found;
  }
  EXPECT_GT(found, 10);
}

TEST(Previews, ReadWhatTheOutputReads) {
  auto graph = load_named("svgf");
  const auto before = fingerprint_text(graph);
  const auto nodes = graph.nodes.size();
  add_preview(graph, 0, load_named("quell:previews/exposed.json"));
  ASSERT_EQ(graph.nodes.size(), nodes + 4);
  for (std::size_t n = nodes; n < graph.nodes.size(); ++n) {
    const auto& node = graph.nodes[n];
    EXPECT_TRUE(node.name.starts_with("color.preview.")) << node.name;
    for (const auto& port : node.in)
      for (const auto& wire : port)
        EXPECT_TRUE(wire == graph.outputs[0].wire || (wire.from.node >= int(nodes) && wire.from.node < int(n)))
            << node.name << " reads its image or a preview node before it";
  }
  EXPECT_EQ(graph.outputs.back().wire.from.node, int(graph.nodes.size()) - 1);
  EXPECT_EQ(fingerprint_text(graph), before) << "a state of a run with previews fits one without";
}

std::string refusal(const std::string& type, const std::string& text) {
  auto graph = through(type);
  try {
    add_preview(graph, 0, load_text(text));
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::usage);
    EXPECT_EQ(graph.outputs.size(), 1u) << "nothing has been added";
    return e.what();
  }
  return "none";
}

TEST(Previews, RefuseGraphsThatAreNone) {
  const auto graph = [](const std::string& inputs, const std::string& in, const std::string& more = "") {
    return R"({"quell": 1, "name": "P", "inputs": {)" + inputs +
           R"(}, "nodes": {"t": {"type": "tonemap", "in": {"image": )" + in + "}}" + more +
           R"(}, "outputs": {"image": "t"}})";
  };
  EXPECT_EQ(refusal("depth", graph(R"("image": "radiance")", R"("image")")),
            "the preview graph 'P' takes 'image' as radiance, but the output 'out' is depth");
  EXPECT_EQ(refusal("radiance", graph(R"("color": "radiance")", R"("color")")),
            "the preview graph 'P' reads 'color', but a preview has one input, 'image'");
  EXPECT_EQ(refusal("radiance", graph(R"("image": "radiance")", R"("e")",
                                      R"(, "e": {"type": "exposure", "in": {"image": "image@-1"}})")),
            "the preview graph 'P' keeps history in 'e': a preview must not, or it would be part of a run's state");
  EXPECT_EQ(refusal("radiance",
                    R"({"quell": 1, "name": "P", "inputs": {"image": "radiance"}, "outputs": {"image": "image"}})"),
            "the preview graph 'P' must give an output of type display first");
}

}  // namespace
}  // namespace quell::test
