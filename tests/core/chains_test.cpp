// Which nodes a plan lets run together, and the memory that this saves.
#include "core/run/plan.h"

#include "tests/support/accumulator.h"

#include <gtest/gtest.h>

namespace quell::test {
namespace {

std::vector<std::pair<std::size_t, std::size_t>> chains(const Plan& plan) {
  std::vector<std::pair<std::size_t, std::size_t>> nodes;
  for (const auto& chain : plan.chains()) nodes.emplace_back(chain.first, chain.end);
  return nodes;
}

// Nodes that read each other at their own rows run together; what no other nor the future reads is a band.
TEST(Chains, ChainsNodesUpToAHalo) {
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("blur", "blur", {{{input(), 0, {}}}}));
  g.nodes.push_back(make("sum", "sum", {{{{0, 0}, 0, {}}}, {{input(), 0, {}}}}));
  g.nodes.push_back(make("total", "sum", {{{{1, 0}, 0, {}}}, {{{2, 0}, 1, {}}}}));
  g.nodes.push_back(make("again", "blur", {{{{2, 0}, 0, {}}}}));
  g.nodes.push_back(make("last", "sum", {{{{3, 0}, 0, {}}}, {{{2, 0}, 0, {}}}}));
  g.outputs = {{"out", {{4, 0}, 0, {}}, QUELL_SCALAR, false}};
  const quell_shape shape{100, 50, 1};
  const Plan plan(g, {&shape, 1});
  EXPECT_EQ(chains(plan), (std::vector<std::pair<std::size_t, std::size_t>>{{0, 3}, {3, 5}}));
  const auto local = [&](int node) { return plan.values()[plan.value_of({node, 0})].local; };
  EXPECT_TRUE(local(0) && local(1) && local(3));
  EXPECT_FALSE(local(2)) << "it is read in the next chain and in the next frame";
  EXPECT_FALSE(local(4)) << "it is an output";
  EXPECT_EQ(plan.arena_floats(), 0u);
  const quell_shape large{3840, 2160, 1};
  EXPECT_LT(Plan(g, {&large, 1}).band_rows(plan.chains()[0], 2, 0), 32) << "what the chain makes must fit the cache";
}

TEST(Chains, WhatTheNextDoNotReadIsNoPartOfTheirChain) {
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("apart", "blur", {{{input(), 0, {}}}}));
  g.nodes.push_back(make("sum", "sum", {{{input(), 0, {}}}, {}}));
  g.nodes.push_back(make("double", "sum", {{{{1, 0}, 0, {}}}, {{{1, 0}, 0, {}}}}));
  g.nodes.push_back(make("steps", "blur", {{{{0, 0}, 0, {}}}}));
  g.nodes[3].instance.set_int(1, 8);
  g.nodes.push_back(make("last", "sum", {{{{3, 0}, 0, {}}}, {{{2, 0}, 0, {}}}}));
  g.outputs = {{"out", {{4, 0}, 0, {}}, QUELL_SCALAR, false}};
  const quell_shape shape{100, 50, 1};
  const Plan plan(g, {&shape, 1});
  EXPECT_EQ(chains(plan), (std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {1, 3}, {3, 4}, {4, 5}}))
      << "rows by residue are for one node alone";
}

TEST(Chains, TellsOrderAndMemory) {
  const Graph g = accumulator();
  const quell_shape shape{100, 50, 1};
  const Plan plan(g, {&shape, 1});
  const auto text = plan.describe();
  EXPECT_NE(text.find("total"), std::string::npos);
  EXPECT_NE(text.find("ring of 3"), std::string::npos);  // of the total: now, one before, one being written
  EXPECT_LE(plan.bytes(), plan.bytes_without_reuse());
}

}  // namespace
}  // namespace quell::test
