// quell test: golden images, conditions, and what CI systems read of it.
#include "tests/support/quell_command.h"

#include <filesystem>

namespace quell::test {
namespace {

class SuiteCommand : public QuellCommand {
 protected:
  void SetUp() override {
    for (const char* frame : {"1", "2", "3"}) {
      write_color(std::string("c.000") + frame + ".exr", 20, 10, 0.5f);
      write_color(std::string("r.000") + frame + ".exr", 20, 10, 0.25f);
    }
    write("shot.json", R"({"quell_sequence": 1, "frames": "1-3", "inputs": {"color": {"file": "c.####.exr"}},
                           "reference": {"file": "r.####.exr"}})");
    suite("rmse > 0.3");
  }
  void suite(const std::string& condition) {
    write("suite.json", R"({
  "quell_suite": 1,
  "name": "Small",
  "tests": {
    "plain": { "graph": "unfiltered", "sequence": "shot.json", "warm_up": 0, "golden": { "frames": "2", "pixel": 0.01 } },
    "judged": { "graph": "gaussian", "set": { "sigma": 1.0 }, "sequence": { "path": "shot.json" }, "warm_up": 0,
                "fail": [")" +
                            condition + R"("] }
  }
})");
  }
  ProgramResult test(std::vector<std::string> args, ProgramOptions options = {}) {
    return quell(std::vector<std::string>{"test", "suite.json"} + args, std::move(options));
  }
};

TEST_F(SuiteCommand, GoldenImagesAreMadeOnceAndHeldTo) {
  auto r = test({});
  EXPECT_EQ(r.exit, 1);
  EXPECT_NE(r.out.find("there is no golden image golden/plain.0002.exr; --update-golden makes it"), std::string::npos)
      << r.out;
  EXPECT_TRUE(r.out.ends_with("1 passed, 1 failed\n")) << r.out;

  r = test({"--update-golden"});
  EXPECT_EQ(r.exit, 0);
  EXPECT_NE(r.out.find("s)\n  golden/plain.0002.exr\n"), std::string::npos) << r.out;
  EXPECT_TRUE(r.out.starts_with("written plain (")) << r.out;
  EXPECT_TRUE(r.out.ends_with("1 passed, 0 failed, 1 written\n")) << r.out;
  EXPECT_EQ(files("golden"), (std::vector<std::string>{"plain.0002.exr"}));
  r = test({"--quiet"});
  EXPECT_EQ(r.exit, 0) << r.out;
  EXPECT_EQ(r.out, "2 passed, 0 failed\n");

  write_color("c.0002.exr", 20, 10, 0.75f);
  r = test({"--failures", "bad"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_NE(r.out.find("frame 2: 200 of 200 pixels (100 %) differ by more than 0.01"), std::string::npos) << r.out;
  EXPECT_EQ(files("bad"), (std::vector<std::string>{"plain.found.0002.exr", "plain.golden.0002.exr"}));
}

TEST_F(SuiteCommand, ConditionsOnMetricsFail) {
  suite("rmse.max > 0.2");
  const auto r = test({"--only", "judged", "--junit", "out.xml"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_NE(r.out.find("FAILED judged"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("\n  rmse.max > 0.2: the max is 0.25\n"), std::string::npos) << r.out;
  EXPECT_TRUE(r.out.ends_with("0 passed, 1 failed\n")) << r.out;
  EXPECT_NE(read("out.xml").find("tests=\"1\" failures=\"1\" errors=\"0\""), std::string::npos) << read("out.xml");
}

TEST_F(SuiteCommand, ConditionsHoldWhileGoldenImagesAreWritten) {
  suite("rmse.max > 0.2");
  const auto r = test({"--update-golden"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_TRUE(r.out.ends_with("0 passed, 1 failed, 1 written\n")) << r.out;
}

TEST_F(SuiteCommand, StdoutIsLeftToJUnit) {
  const auto r = test({"--only", "judged", "--junit", "-"});
  EXPECT_EQ(r.exit, 0) << r.err;
  EXPECT_TRUE(r.out.starts_with("<?xml") && r.out.ends_with("</testsuites>\n")) << r.out;
  EXPECT_NE(r.err.find("1 passed, 0 failed\n"), std::string::npos) << r.err;
  EXPECT_FALSE(std::filesystem::exists(path("-")));
}

TEST_F(SuiteCommand, ASuiteThatIsWrongItselfIsToldToCiToo) {
  write("suite.json", R"({ "quell_suite": 1, "tests": {} })");
  const auto r = test({"--junit", "out.xml"}, {.environment = {{"GITHUB_ACTIONS", "true"}}});
  EXPECT_EQ(r.exit, 2);
  EXPECT_EQ(r.out, "::error file=suite.json,line=1,title=suite::a suite needs \"tests\": at least one, by name\n");
  EXPECT_NE(read("out.xml").find("errors=\"1\""), std::string::npos) << read("out.xml");
}

TEST_F(SuiteCommand, AllThatIsWrongWithATestIsSaidTogether) {
  write(
      "suite.json",
      R"({ "quell_suite": 1, "tests": { "a": { "graph": "nope", "sequence": "nope.json", "fail": ["nope > 1"] } } })");
  const auto r = test({});
  EXPECT_EQ(r.exit, 3) << r.err;
  EXPECT_NE(r.err.find("tests.a.sequence: cannot read 'nope.json'"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("there is no metric 'nope'"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("there is no graph 'nope'"), std::string::npos) << r.err;
}

TEST_F(SuiteCommand, AWarmUpLeavesAFrameToBeJudged) {
  write("suite.json", R"({ "quell_suite": 1, "tests": {
    "a": { "graph": "unfiltered", "sequence": "shot.json", "fail": ["rmse > 1"] },
    "b": { "graph": "unfiltered", "sequence": "shot.json", "golden": { "frames": "2" } } } })");
  const auto r = test({});
  EXPECT_EQ(r.exit, 2);
  EXPECT_EQ(r.err,
            "suite.json:2:47: error: tests.a.sequence: the warm-up of 4 takes all 3 of its frames, so that none is "
            "judged\n  \"warm_up\" is 4 where the file does not say it; 2 is the most for this sequence\n");
}

TEST_F(SuiteCommand, ALostFrameIsAnErrorOfItsTestAlone) {
  std::filesystem::remove(path("c.0003.exr"));
  const auto r = test({"--junit", "out.xml"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_NE(r.out.find("error: frame 3: color: "), std::string::npos) << r.out;
  EXPECT_TRUE(r.out.ends_with("0 passed, 2 failed\n")) << r.out;
  EXPECT_NE(read("out.xml").find("errors=\"2\""), std::string::npos);
}

TEST_F(SuiteCommand, FailuresAreShownBesideTheirLinesInGitHubActions) {
  const auto r = test({"--only", "plain"}, {.environment = {{"GITHUB_ACTIONS", "true"}}});
  EXPECT_NE(r.out.find("::error file=suite.json,line=5,title=plain::frame 2: there is no golden image"),
            std::string::npos)
      << r.out;
}

TEST_F(SuiteCommand, WhatIsWrongWithASuiteIsSaidBeforeAnyTestRuns) {
  write("suite.json", R"({
  "quell_suite": 1,
  "tests": {
    "a": { "graph": "unfilterd", "sequence": "shot.json", "fail": ["rmse > 1"] },
    "b": { "graph": "unfiltered", "sequence": "shot.json", "fail": ["rmze > 1", "rmse"] },
    "c": { "graph": "unfiltered", "sequence": "shot.json" },
    "d": { "graph": "unfiltered", "golden": { "frames": "x", "share": 2 }, "speed": 1 },
    "e": { "graph": "unfiltered", "sequence": "shut", "golden": { "frames": "0-5000" } },
    "f": { "sequence": ["shot.json"], "fail": ["rmse > 1"] }
  }
})");
  auto r = test({});
  EXPECT_EQ(r.exit, 2);
  EXPECT_EQ(r.out, "");
  EXPECT_NE(r.err.find("suite.json:5:81: error: tests.b.fail[1]: the condition 'rmse': expected"), std::string::npos)
      << r.err;
  EXPECT_NE(r.err.find("suite.json:6:5: error: tests.c: tests nothing; it needs \"golden\" images or conditions to "
                       "\"fail\" on"),
            std::string::npos)
      << r.err;
  EXPECT_NE(r.err.find("tests.d: unknown key 'speed'"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("tests.d.golden.share: must be a number from 0 to 1, not 2"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("tests.d: has no \"sequence\""), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("suite.json:8:47: error: tests.e.sequence: there is no sequence 'shut'"), std::string::npos)
      << r.err;
  EXPECT_NE(r.err.find("tests.e.golden.frames: names 5001 frames; the most are 1000"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("tests.f.sequence: a test has one sequence, not a list"), std::string::npos) << r.err;

  write("suite.json", R"({
  "quell_suite": 1,
  "tests": {
    "a": { "graph": "unfilterd", "sequence": "shot.json", "fail": ["rmse > 1"] },
    "b": { "graph": "unfiltered", "sequence": "shot.json", "fail": ["rmze > 1"] }
  }
})");
  r = test({});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("'unfilterd'"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("there is no metric 'rmze'"), std::string::npos) << r.err;
  suite("rmse > 1");
  EXPECT_EQ(test({"--only", "none"}).exit, 2);
}

}  // namespace
}  // namespace quell::test
