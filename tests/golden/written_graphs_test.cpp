// Each graph that ships is the same graph when it has been written and loaded again.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/graph/write.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"
#include "tests/support/run_shipped.h"

namespace quell::test {
namespace {

TEST(WrittenGraphs, AreTheSameLoadedAgain) {
  const std::filesystem::path graphs = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs";
  for (const auto& name : installed_graphs(graphs)) {
    SCOPED_TRACE(name);
    const Graph graph = shipped_graph(name);
    const auto written = write_graph(graph, graphs);
    EXPECT_TRUE(written.files.empty()) << "it stands for itself";
    GraphRequest request;
    request.graph = "written.json";
    request.text = written.text;
    request.graphs = graphs;
    Diagnostics diagnostics;
    const auto again = load_graph(request, registry(), diagnostics);
    ASSERT_TRUE(again) << diagnostics.format() << written.text;
    EXPECT_EQ(diagnostics.format(), "");
    EXPECT_EQ(fingerprint_text(*again), fingerprint_text(graph));
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
      EXPECT_EQ(again->nodes[n].out_types, graph.nodes[n].out_types) << graph.nodes[n].name;
  }
}

}  // namespace
}  // namespace quell::test
