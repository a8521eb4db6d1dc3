// Merged graphs: the bits of the graphs alone, and nothing computed twice.
#include "core/lab/merge.h"

#include "core/report/error.h"
#include "tests/support/random_graph.h"

#include <gtest/gtest.h>

#include <numeric>

namespace quell::test {
namespace {

// The same graph, its nodes renamed and in another order that is one.
Graph reordered(const Graph& from, Random& random) {
  const std::size_t count = from.nodes.size();
  std::vector<int> place(count, -1);
  Graph graph = from;
  graph.nodes.clear();
  std::vector<std::size_t> order;
  const auto ready = [&](const Source& s) { return s.node < 0 || place[std::size_t(s.node)] >= 0; };
  while (order.size() < count) {
    std::vector<std::size_t> next;
    for (std::size_t n = 0; n < count; ++n) {
      bool fits = place[n] < 0;
      for (const auto& port : from.nodes[n].in)
        for (const auto& w : port) fits = fits && (w.delay || ready(w.from)) && ready(w.start);
      if (fits) next.push_back(n);
    }
    const auto chosen = next[std::size_t(random.below(int(next.size())))];
    place[chosen] = int(order.size());
    order.push_back(chosen);
  }
  const auto moved = [&](Source& s) {
    if (s.node >= 0) s.node = place[std::size_t(s.node)];
  };
  for (const auto n : order) {
    auto& node = graph.nodes.emplace_back(from.nodes[n]);
    node.name = fmt::format("m{}", graph.nodes.size());
    for (auto& port : node.in)
      for (auto& w : port) moved(w.from), moved(w.start);
  }
  for (auto& o : graph.outputs) moved(o.wire.from), moved(o.wire.start);
  return graph;
}

// Another number, delay or source somewhere.
Graph edited(Graph graph, Random& random) {
  auto& node = graph.nodes[std::size_t(random.below(int(graph.nodes.size())))];
  auto& wire = node.in[0][0];
  switch (random.below(4)) {
    case 0:
      if (!node.type().params().empty()) node.instance.set_float(0, float(random.below(3)));
      break;
    case 1:
      if (wire.delay) wire.delay = 1 + random.below(4);
      break;
    case 2:
      wire.start = {};
      break;
    default:
      wire.from = {Source::kInput, 0};
  }
  return graph;
}

Kept run_alone(const Graph& graph, const Course& course, unsigned seed, const RunOptions& options) {
  Kept kept;
  run_part(graph, course, 0, course.frames.size(), seed, options, kept);
  return kept;
}

std::size_t nodes_of(std::span<const Graph> graphs) {
  return std::accumulate(graphs.begin(), graphs.end(), std::size_t(0),
                         [](std::size_t sum, const Graph& g) { return sum + g.nodes.size(); });
}

Merged merge_all(std::span<const Graph> graphs) {
  std::vector<MergePart> parts;
  for (const auto& g : graphs) parts.push_back({fmt::format("v{}", parts.size()), &g});
  return merge(parts);
}

TEST(Merge, GivesTheBitsOfTheGraphsAloneAndComputesWhatTheyShareOnce) {
  std::size_t merged_nodes = 0, separate_nodes = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const RandomGraph made(random);
    const auto course = random_course(random);
    std::vector<Graph> graphs{made.graph()};
    for (int v = random.below(4); v >= 0; --v) graphs.push_back(reordered(edited(made.graph(), random), random));
    std::erase_if(graphs, [](const Graph& g) { return !has_sizes(g); });
    if (graphs.empty()) continue;
    const auto merged = merge_all(graphs);
    merged_nodes += merged.graph.nodes.size(), separate_nodes += nodes_of(graphs);

    RunOptions options;
    options.threads = 1 + random.below(3);
    Kept expected;
    for (const auto& g : graphs)
      for (auto& [frame, images] : run_alone(g, course, seed, options))
        std::ranges::move(images, std::back_inserter(expected[frame]));
    ASSERT_EQ(first_difference(run_alone(merged.graph, course, seed, options), expected), "")
        << "seed " << seed << "\n"
        << fingerprint_text(merged.graph);
  }
  EXPECT_LT(merged_nodes, separate_nodes * 6 / 10);
}

TEST(Merge, FindsAGraphAgainInAnyOrderAndUnderAnyNames) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const RandomGraph made(random);
    const Graph alone[] = {made.graph()};
    const auto once = merge_all(alone);
    const Graph again[] = {made.graph(), reordered(made.graph(), random)};
    const auto twice = merge_all(again);
    ASSERT_EQ(twice.graph.nodes.size(), once.graph.nodes.size()) << "seed " << seed;
    EXPECT_LE(once.graph.nodes.size(), made.graph().nodes.size());
    // Every wire of every part leads where its node's stand-in reads.
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t n = 0; n < again[p].nodes.size(); ++n) {
        const auto& node = again[p].nodes[n];
        const auto& stands = twice.graph.nodes[std::size_t(twice.places[p][n])];
        ASSERT_EQ(stands.instance.describe(), node.instance.describe());
        for (std::size_t i = 0; i < node.in.size(); ++i)
          for (std::size_t w = 0; w < node.in[i].size(); ++w)
            if (const auto& wire = node.in[i][w]; wire.from.node >= 0) {
              EXPECT_EQ(stands.in[i][w].from.node, twice.places[p][std::size_t(wire.from.node)]);
              EXPECT_EQ(stands.in[i][w].delay, wire.delay);
            }
      }
  }
}

GraphNode mix(const std::string& name, float number, Wire a) {
  const auto* type = nodes().find("mix");
  GraphNode node{name, Instance(*type), {{a}, {}}, {QUELL_SCALAR, QUELL_SCALAR}, {}};
  node.instance.set_float(0, number);
  return node;
}

// Two nodes in a ring over one frame of delay, beside the input; `tail` of them in a row behind it.
Graph ring(float first, float second, int tail) {
  Graph graph;
  graph.inputs.push_back({"i0", QUELL_SCALAR, false});
  graph.nodes.push_back(mix("a", first, {{1, 0}, 1, {Source::kInput, 0}}));
  graph.nodes.push_back(mix("b", second, {{0, 0}, 0, {}}));
  for (int t = 0; t < tail; ++t)
    graph.nodes.push_back(mix(fmt::format("t{}", t), float(t + 10), {{int(graph.nodes.size()) - 1, 0}, 0, {}}));
  graph.outputs.push_back({"o", {{int(graph.nodes.size()) - 1, 0}, 0, {}}, QUELL_SCALAR, false});
  return graph;
}

TEST(Merge, JoinsEqualFeedbackLoops) {
  const Graph graphs[] = {ring(1, 2, 3), ring(1, 2, 5), ring(1, 2, 0)};
  const auto merged = merge_all(graphs);
  EXPECT_EQ(merged.graph.nodes.size(), 7u);
  EXPECT_EQ(merged.places[2], (std::vector<int>{0, 1}));
  EXPECT_EQ(merged.graph.outputs[1].name, "v1/o");
  EXPECT_EQ(merged.graph.outputs[1].wire.from.node, merged.places[1][6]);
  EXPECT_EQ(merged.graph.nodes[0].name, "v0/a");
}

TEST(Merge, KeepsLoopsApartThatDifferAnywhere) {
  const Graph graphs[] = {ring(1, 2, 0), ring(1, 3, 0)};
  EXPECT_EQ(merge_all(graphs).graph.nodes.size(), 4u);
  Graph other = ring(1, 2, 0);
  other.nodes[0].in[0][0].start = {};
  const Graph starts[] = {ring(1, 2, 0), other};
  EXPECT_EQ(merge_all(starts).graph.nodes.size(), 4u);
  other = ring(1, 2, 0);
  other.nodes[0].in[0][0].delay = 2;
  const Graph delays[] = {ring(1, 2, 0), other};
  EXPECT_EQ(merge_all(delays).graph.nodes.size(), 4u);
}

// What looks alike but reads different roles.
TEST(Merge, TellsInputsApartByName) {
  Graph other = ring(1, 2, 0);
  other.inputs[0].name = "i1";
  const Graph graphs[] = {ring(1, 2, 0), other};
  const auto merged = merge_all(graphs);
  ASSERT_EQ(merged.graph.inputs.size(), 2u);
  EXPECT_EQ(merged.graph.inputs[1].name, "i1");
  EXPECT_EQ(merged.graph.nodes.size(), 4u);
}

TEST(Merge, RefusesOneRoleAsTwoTypes) {
  Graph other = ring(1, 2, 0);
  other.inputs[0].type = QUELL_DEPTH;
  const Graph graphs[] = {ring(1, 2, 0), other};
  try {
    merge_all(graphs);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "'i0' is read as scalar and as depth");
  }
}

// A chain is told apart in one round, however long it is.
TEST(Merge, TakesLongChains) {
  const Graph graphs[] = {ring(1, 2, 20'000), ring(1, 3, 20'000)};
  EXPECT_EQ(merge_all(graphs).graph.nodes.size(), 40'004u);
}

TEST(Merge, CopiesOutputsThatAreInputsAndWhatPreviewsShow) {
  Graph graph = ring(1, 2, 0);
  graph.outputs.push_back({"in", {{Source::kInput, 0}, 0, {}}, QUELL_SCALAR, false});
  graph.outputs.push_back({"o", {{0, 0}, 0, {}}, QUELL_DISPLAY, true, 0});
  const Graph graphs[] = {graph, graph};
  const auto merged = merge_all(graphs);
  ASSERT_EQ(merged.graph.outputs.size(), 6u);
  EXPECT_EQ(merged.graph.outputs[4].wire.from, (Source{Source::kInput, 0}));
  EXPECT_EQ(merged.graph.outputs[5].shows, 3);
}

}  // namespace
}  // namespace quell::test
