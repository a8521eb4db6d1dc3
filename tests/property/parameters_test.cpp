// Every parameter of every shipped graph and of every node in it is reachable by --set, refused out of its range in
// words that say the range, and documented with its unit: found from the tables.
#include "core/plugin/document.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"
#include "tests/support/run_shipped.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quell::test {
namespace {

struct Loaded {
  std::string fingerprint, refusal;  // one of the two
  GraphInfo info;
};
Loaded load(const std::string& name, const std::string& set = "") {
  GraphRequest request;
  request.graph = name;
  request.graphs = QUELL_TEST_SOURCE "/graphs";
  if (!set.empty()) request.edits.push_back({Edit::Kind::set, set});
  Loaded loaded;
  Diagnostics diagnostics;
  const auto graph = load_graph(request, registry(), diagnostics, &loaded.info);
  if (graph)
    loaded.fingerprint = fingerprint_text(*graph);
  else
    loaded.refusal = diagnostics.format();
  return loaded;
}

bool is_number(const quell_param& p) { return p.kind == QUELL_INT || p.kind == QUELL_FLOAT || p.kind == QUELL_FLOATS; }
std::string number(const quell_param& p, double v) {
  const auto one = p.kind == QUELL_INT ? fmt::format("{:.0f}", v) : fmt::format("{}", v);
  return p.kind == QUELL_FLOATS ? fmt::format("[{}]", fmt::join(std::vector(std::size_t(p.count), one), ",")) : one;
}

// Two values that differ, so that one of them is not what the graph has.
std::vector<std::string> good_values(const quell_param& p) {
  if (p.kind == QUELL_BOOL) return {"false", "true"};
  if (p.kind == QUELL_CHOICE) return {p.choices[0], p.choices[p.choice_count - 1]};
  if (!is_number(p)) return {"one", "two"};
  return {number(p, p.min), number(p, p.max)};
}

std::vector<std::string> bad_values(const quell_param& p) {
  std::vector<std::string> list;
  if (p.kind == QUELL_BOOL) list = {"3", "maybe"};
  if (p.kind == QUELL_CHOICE) list = {"3", "neither"};
  if (is_number(p)) {
    list = {"true", "[]"};
    if (std::isfinite(p.min)) list.push_back(number(p, p.min - 1));
    if (std::isfinite(p.max)) list.push_back(number(p, p.max * 1.01 + 1));
  }
  if (p.kind == QUELL_INT) list.push_back(fmt::format("{}.5", p.min));
  return list;
}

class Parameters : public testing::TestWithParam<std::string> {
 protected:
  void check(const std::string& name, const quell_param& p) {
    SCOPED_TRACE(name);
    std::vector<std::string> results;
    for (const auto& value : good_values(p)) {
      const auto set = load(GetParam(), name + "=" + value);
      EXPECT_EQ(set.refusal, "") << value;
      results.push_back(set.fingerprint);
    }
    EXPECT_NE(results[0], results[1]) << "setting it changes nothing";
    for (const auto& value : bad_values(p)) {
      const auto set = load(GetParam(), name + "=" + value);
      for (const std::string& part : {"is not " + takes(p), std::string(p.doc)})
        EXPECT_NE(set.refusal.find(part), std::string::npos) << value << ": " << set.refusal;
    }
  }
};

TEST_P(Parameters, OfTheGraphFeedDocumentedOnes) {
  const auto plain = load(GetParam());
  ASSERT_EQ(plain.refusal, "");
  for (const auto& param : plain.info.params) {
    ASSERT_FALSE(param.feeds.empty()) << param.name << " feeds nothing";
    EXPECT_FALSE(param.takes.empty() || param.doc.empty()) << param.name;
    EXPECT_EQ(load(GetParam(), param.name + "=" + param.value).fingerprint, plain.fingerprint) << param.name;
    const auto node = param.feeds[0].substr(0, param.feeds[0].rfind('.')),
               name = param.feeds[0].substr(node.size() + 1);
    const Graph graph = shipped_graph(GetParam());
    const auto fed = std::ranges::find(graph.nodes, node, &GraphNode::name);
    ASSERT_NE(fed, graph.nodes.end()) << node;
    check(param.name, fed->type().params()[std::size_t(fed->type().find_param(name))]);
    EXPECT_STRNE(fed->type().table().source, "") << node << " says not where it is from";
  }
}

TEST_P(Parameters, OfNodesAreReachable) {
  const Graph graph = shipped_graph(GetParam());
  for (const auto& node : graph.nodes)
    for (const auto& p : node.type().params()) check(node.name + "." + p.name, p);
}

INSTANTIATE_TEST_SUITE_P(All, Parameters, testing::ValuesIn(installed_graphs(QUELL_TEST_SOURCE "/graphs")),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quell::test
