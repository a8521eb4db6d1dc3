// Studies: what their sweeps and automatic ablations come to, and what their numbers come to in tables.
#include "core/lab/study.h"
#include "core/lab/edits.h"
#include "core/lab/results.h"
#include "core/lab/tables.h"
#include "tests/support/scratch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace quell::test {
namespace {

std::vector<StudyVariant> variants_of(const std::string& keys) {
  const Scratch scratch;
  const auto file = scratch.path("study.json");
  std::ofstream(file) << R"({ "quell_study": 1, "graph": "svgf", "sequences": ["a.json"], "metrics": ["mse"], )" << keys
                      << "}";
  Diagnostics diagnostics;
  const auto study = load_study({file, scratch.path("graphs")}, diagnostics);
  EXPECT_TRUE(study) << diagnostics.format();
  return study ? study->variants : std::vector<StudyVariant>();
}

std::vector<std::string> names_of(const std::vector<StudyVariant>& variants) {
  std::vector<std::string> names;
  for (const auto& v : variants) names.push_back(v.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Study, CrossesSweepsAndTakesOthersAlone) {
  const auto variants =
      variants_of(R"("sweeps": { "a": [1, 0.5], "n.b": ["x", true] }, "sweep_separately": { "c": [[1, 2]] })");
  EXPECT_EQ(names_of(variants), (Names{"base", "a=1,n.b=x", "a=1,n.b=true", "a=0.5,n.b=x", "a=0.5,n.b=true", "c=1,2"}));
  EXPECT_EQ(edits_text(variants[3].edits), R"({"set":{"a":0.5,"n.b":"x"}})");
  EXPECT_EQ(edits_text(variants[5].edits), R"({"set":{"c":[1,2]}})");
  EXPECT_EQ(edits_text(variants[0].edits), "{}");
}

TEST(Study, SpacesRangesEvenlyOrByFactors) {
  EXPECT_EQ(names_of(variants_of(R"("sweeps": { "a": { "from": 1, "to": 8, "steps": 4, "scale": "log" } })")),
            (Names{"base", "a=1", "a=2", "a=4", "a=8"}));
  EXPECT_EQ(names_of(variants_of(R"("sweeps": { "a": { "from": 0, "to": -1, "steps": 3 } })")),
            (Names{"base", "a=0", "a=-0.5", "a=-1"}));
  // What the name says is what is set.
  const auto thirds = variants_of(R"("sweeps": { "a": { "from": 0, "to": 1, "steps": 4 } })");
  EXPECT_EQ(thirds[3].name, "a=0.666667");
  EXPECT_EQ(edits_text(thirds[3].edits), R"({"set":{"a":0.666667}})");
}

TEST(Study, StepsThroughTheSmallestNumbers) {
  EXPECT_EQ(names_of(variants_of(R"("sweeps": { "a": { "from": 0, "to": 1e-310, "steps": 3 } })")),
            (Names{"base", "a=0", "a=5e-311", "a=1e-310"}));
}

TEST(Study, LeavesOutAndFeedsBack) {
  const auto variants =
      variants_of(R"("leave_one_out": ["x", ["y", "z.w"]], "baselines": ["gaussian", "other/flat.json"],
    "each_feedback_level": { "wire": "h.image", "levels": ["x", "y.image@-2"] }, "variants": { "v": { "graph": "eaw" } })");
  EXPECT_EQ(names_of(variants),
            (Names{"base", "v", "no_x", "no_y+z.w", "feedback=x", "feedback=y.image_-2", "gaussian", "flat"}));
  EXPECT_EQ(edits_text(variants[3].edits), R"({"bypass":["y","z.w"]})");
  EXPECT_EQ(edits_text(variants[4].edits), R"({"wire":{"h.image":"x@-1"}})");
  EXPECT_EQ(edits_text(variants[5].edits), R"({"wire":{"h.image":"y.image@-2"}})");
  EXPECT_EQ(variants[1].graph, "eaw");
  EXPECT_EQ(variants[6].graph, "gaussian");
  EXPECT_TRUE(variants[7].graph.ends_with("/other/flat.json"));
  EXPECT_TRUE(variants[7].baseline);
}

TEST(Study, SaysCommandsThatAShellReadsAsTheyAre) {
  Study study;
  study.sequences.push_back({"s", "room", "graphs/sequences/room.json", "0-3", {}, {}, {}, {}, ""});
  auto variants = variants_of(
      R"("variants": { "v": { "set": { "a": "it's 5", "b": [1, 2], "c": "12" }, "bypass": "n", "wire": { "h.i": ["x", "y@-1"] } } })");
  EXPECT_EQ(
      run_command(study, variants[1]),
      R"(quell run svgf room --frames 0-3 --wire 'h.i=["x","y@-1"]' --set 'a=it'\''s 5' --set 'b=[1,2]' --set 'c="12"' --bypass n)");
}

Results results() {
  Results r;
  r.name = "a_b", r.warm_up = 1, r.version = "1", r.simd = "scalar";
  r.metrics = {{"low", "Low", "", false, 0.0}, {"high", "High", "dB", true, std::nullopt}};
  for (const char* name : {"base", "a,b_c"}) r.variants.push_back({name, "", "{}", "{}", "f", "c", 1, 1, false});
  r.sequences = {{"s", "s.json", 4, 3, {1, 2, 3}}};
  const auto frame = [](std::optional<double> low, std::optional<double> high) { return FrameNumbers{low, high}; };
  r.numbers = {
      {{{frame(9, 9), frame(0.25, 30), frame(0.5, 32)}, {frame(9, 9), frame(0.125, std::nullopt), frame(0.25, 31)}}}};
  return r;
}

TEST(Results, SumUpWhatIsBehindTheWarmUp) {
  const auto all = summaries(results());
  ASSERT_EQ(all.size(), 4u);
  EXPECT_DOUBLE_EQ(all[0].summary.mean, 0.375);
  // Of two numbers: t of one degree of freedom times half their distance.
  EXPECT_NEAR(all[0].summary.high - all[0].summary.mean, 12.7062 * 0.125, 1e-4);
  EXPECT_EQ(all[3].summary.count, 1u);
  EXPECT_EQ(all[3].summary.mean, 31);
  // Pairs of frames, where both have a number.
  EXPECT_DOUBLE_EQ(all[2].difference.mean, -0.1875);
  EXPECT_EQ(all[3].difference.count, 1u);
  EXPECT_DOUBLE_EQ(all[3].difference.mean, -1);
}

TEST(Results, AreTablesWithTheBestBoldAndArrows) {
  const auto markdown = table_markdown(results(), {{1.25, 0.5}, {{1.25, 0.5}}});
  EXPECT_NE(markdown.find("# a\\_b\n"), std::string::npos);
  EXPECT_NE(markdown.find("| variant | Low ↓ | High [dB] ↑ | cost [ms] ↓ |\n|---|---:|---:|---:|\n"), std::string::npos)
      << markdown;
  EXPECT_NE(markdown.find("| a,b\\_c | **0.2** ± 0.8 |"), std::string::npos) << markdown;
  EXPECT_NE(markdown.find("| 0.5 |\n"), std::string::npos) << markdown;
  const auto latex = table_latex(results(), {});
  EXPECT_NE(latex.find("Variant & Low $\\downarrow$ & High [dB] $\\uparrow$ \\\\\n"), std::string::npos) << latex;
  EXPECT_NE(latex.find("a,b\\_c & \\textbf{0.2} $\\pm$ 0.8"), std::string::npos) << latex;
  EXPECT_EQ(latex.find("cost"), std::string::npos);
}

TEST(Results, QuoteNamesWithCommasInCsv) {
  EXPECT_NE(results_csv(results()).find("\n\"a,b_c\",s,,2,high,\n"), std::string::npos) << results_csv(results());
}

}  // namespace
}  // namespace quell::test
