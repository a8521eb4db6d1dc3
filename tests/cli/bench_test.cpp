// quell bench and --trace, as they are called.
#include "tests/support/quell_command.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace quell::test {
namespace {

class Bench : public QuellCommand {
 protected:
  // Of the shipped SVGF at a size that takes no time.
  ProgramResult bench(const std::vector<std::string>& args) {
    return quell(std::vector<std::string>{"bench", "svgf", "--frames", "2", "--warmup", "1"} + args);
  }
};

const std::vector<std::string> kSmall = {"--size", "40x30"};

TEST_F(Bench, TheTableNamesNodesAndTheFilesHoldThem) {
  const auto r = bench(kSmall + std::vector<std::string>{"--json", "b.json", "--trace", "t.json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_NE(r.out.find("level0.atrous"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("whole graph"), std::string::npos) << r.out;
  const auto j = nlohmann::json::parse(read("b.json"));
  EXPECT_EQ(j["width"], 40);
  EXPECT_EQ(j["frames"], 2);
  EXPECT_EQ(j["input"], "synthetic");
  EXPECT_EQ(nlohmann::json::parse(read("t.json"))["traceEvents"].empty(), false);
}

TEST_F(Bench, JsonAloneGoesToStdout) {
  const auto r = bench(kSmall + std::vector<std::string>{"--json", "-"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(nlohmann::json::parse(r.out)["quell_bench"], 1);
  EXPECT_NE(r.err.find("whole graph"), std::string::npos);
}

TEST_F(Bench, ASequenceShorterThanTheMeasurementStartsAnew) {
  const auto r = quell({"bench", "svgf", "room", "--source", "width=64", "--source", "height=36", "--frames", "33",
                        "--warmup", "0", "--json", "b.json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = nlohmann::json::parse(read("b.json"));
  EXPECT_EQ(j["input"], "room");
  EXPECT_EQ(j["width"], 64);
  EXPECT_EQ(j["resets"], 2);
}

// A baseline that took no time at all, or an age: what is measured now is slower, or faster, on any machine.
TEST_F(Bench, FailsWhenSlowerThanTheBaseline) {
  ASSERT_EQ(bench(kSmall + std::vector<std::string>{"--json", "b.json"}).exit, 0);
  const auto compared = [&](double ms, const std::vector<std::string>& more) {
    auto j = nlohmann::json::parse(read("b.json"));
    for (auto& value : j["ms"]) value = ms;
    for (auto& node : j["nodes"])
      for (auto& value : node["ms"]) value = ms;
    write("old.json", j.dump());
    return bench(kSmall + std::vector<std::string>{"--baseline", "old.json"} + more);
  };
  const auto faster = compared(1e6, {"--fail-slower", "5"});
  EXPECT_EQ(faster.exit, 0) << faster.err;
  EXPECT_NE(faster.out.find("faster"), std::string::npos) << faster.out;
  const auto slower = compared(1e-9, {"--fail-slower", "5"});
  EXPECT_EQ(slower.exit, 1) << slower.err;
  EXPECT_NE(slower.out.find("slower"), std::string::npos) << slower.out;
  EXPECT_EQ(compared(1e-9, {}).exit, 0) << "without --fail-slower it only says so";
}

TEST_F(Bench, MistakesAreExplained) {
  write("empty.json", "{}");
  const std::pair<std::vector<std::string>, const char*> mistakes[] = {
      {{"--size", "40"}, "--size 40: expected WIDTHxHEIGHT in pixels, as in 1920x1080"},
      {{"--fail-slower", "5"}, "--fail-slower needs --baseline FILE: slower than what?"},
      {{"room", "--size", "40x30"}, "the frames of room have a size of their own"},
      {{"--source", "width=64"}, "--root and --source belong to a SEQUENCE, and none is given"},
      {{"--baseline", "nowhere.json"}, "nowhere.json: cannot be read"},
      {{"--baseline", "empty.json"}, "empty.json: not a measurement that quell bench --json wrote"},
  };
  for (const auto& [args, says] : mistakes) {
    const auto r = bench(args);
    EXPECT_TRUE(r.exit == 2 || r.exit == 3) << r.exit << ' ' << r.err;
    EXPECT_NE(r.err.find(says), std::string::npos) << says << "\nin\n" << r.err;
  }
}

TEST_F(Bench, RunWritesATraceToo) {
  const auto r = run_room("svgf", {"--trace", "t.json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = nlohmann::json::parse(read("t.json"));
  EXPECT_TRUE(std::ranges::any_of(j["traceEvents"], [](const auto& e) { return e["name"] == "write"; }));
}

}  // namespace
}  // namespace quell::test
