// quell tune: what it finds, that it goes on where it was stopped, and what it says of wrong files.
#include "tests/support/quell_command.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

namespace quell::test {
namespace {

using nlohmann::json;

class Tune : public QuellCommand {
 protected:
  // `exposure` by 3 stops makes the frames their reference.
  void SetUp() override {
    for (const char* frame : {"1", "2", "3"}) {
      write_color(std::string("c.000") + frame + ".exr", 16, 8, 0.125f);
      write_color(std::string("r.000") + frame + ".exr", 16, 8, 1.0f);
    }
    write("shot.json", R"({"quell_sequence": 1, "frames": "1-3", "inputs": {"color": {"file": "c.####.exr"}},
                           "reference": {"file": "r.####.exr"}})");
    write("brighten.json", R"({"quell": 1, "inputs": {"color": "radiance"}, "params": {"stops": 0.0},
      "nodes": {"expose": {"type": "exposure", "in": {"image": "color"}, "set": {"stops": "$stops"}}},
      "outputs": {"color": "expose"}})");
    tuning(R"("stops": { "from": -1, "to": 7 })", "rmse.max", 40);
  }
  void tuning(const std::string& parameters, const std::string& minimise, int evaluations,
              const std::string& graph = "brighten.json", const std::string& held_out = "3") {
    write("tune.json", fmt::format(R"({{
  "quell_tune": 1,
  "name": "Brightness",
  "graph": "{}",
  "parameters": {{ {} }},
  "minimise": "{}",
  "train": [{{ "path": "shot.json", "frames": "1-2" }}],
  "held_out": [{{ "path": "shot.json", "frames": "{}", "name": "last" }}],
  "evaluations": {},
  "tolerance": 0.0001,
  "warm_up": 0
}})",
                                   graph, parameters, minimise, held_out, evaluations));
  }
  ProgramResult tune(std::vector<std::string> args) {
    return quell(std::vector<std::string>{"tune", "tune.json"} + args);
  }
};

TEST_F(Tune, FindsTheParameterAndWritesAGraphWithIt) {
  const auto r = tune({"-o", "found"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = json::parse(read("found/tuning.json"));
  EXPECT_NEAR(j["best"]["stops"].get<double>(), 3, 0.01);
  EXPECT_NEAR(j["training"]["before"]["value"].get<double>(), 0.875, 1e-6);
  EXPECT_LT(j["training"]["after"]["value"].get<double>(), 0.01);
  EXPECT_LT(j["held_out"]["after"]["value"].get<double>(), 0.01);
  // How it was made: enough to run the very graph again.
  write("best.json", j["graph"].dump());
  const auto checked = quell({"check", "best.json", "--json"});
  ASSERT_EQ(checked.exit, 0) << checked.err;
  EXPECT_EQ(json::parse(checked.out)["graph"]["fingerprint"], j["fingerprint"]);
  EXPECT_NE(j["plugins"].get<std::string>().find("exposure "), std::string::npos) << j["plugins"];
  EXPECT_TRUE(j["quell"].is_string() && j["simd"].is_string());
  EXPECT_NE(j["command"].get<std::string>().find("tune tune.json -o found"), std::string::npos) << j["command"];
  ASSERT_EQ(quell({"run", "found/variant.json", "shot.json", "-o", "o/x.####.exr", "--quiet"}).exit, 0);
  EXPECT_NEAR(pixels("o/x.0001.exr").channels.at("G")[0], 1, 0.01);
}

TEST_F(Tune, TriesWholeNumbersOnly) {
  write("soften.json", R"({"quell": 1, "inputs": {"color": "radiance"}, "params": {"radius": 2},
    "nodes": {"soften": {"type": "gaussian", "in": {"image": "color"}, "set": {"kernel": "box", "radius": "$radius"}}},
    "outputs": {"color": "soften"}})");
  tuning(R"("radius": { "from": 1, "to": 6, "integer": true })", "rmse", 12, "soften.json");
  const auto r = tune({"-o", "whole", "--quiet"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = json::parse(read("whole/tuning.json"));
  std::set<double> tried;
  for (const auto& step : j["steps"]) tried.insert(step["parameters"][0].get<double>());
  EXPECT_GT(tried.size(), 1u);
  for (const double radius : tried) EXPECT_EQ(radius, std::round(radius));
  EXPECT_TRUE(j["best"]["radius"].is_number_integer());
  EXPECT_EQ(quell({"run", "whole/variant.json", "shot.json", "-o", "o/x.####.exr", "--quiet"}).exit, 0);
}

TEST_F(Tune, StartsFromTheGraphItself) {
  const auto first = [&] {
    const auto r = tune({"-o", "t", "--quiet", "--restart"});
    EXPECT_EQ(r.exit, 0) << r.err;
    return json::parse(read("t/tuning.json"))["steps"][0]["parameters"][0].get<double>();
  };
  tuning(R"("stops": { "from": -1, "to": 7 })", "rmse", 2);
  EXPECT_EQ(first(), 0) << "as the graph has it";
  tuning(R"("expose.stops": { "from": -1, "to": 7 })", "rmse", 2);
  EXPECT_EQ(first(), 0) << "by whatever name";
  tuning(R"("stops": { "from": 1, "to": 7 })", "rmse", 2);
  EXPECT_EQ(first(), 4) << "the range does not hold it";
  tuning(R"("stops": { "from": -1, "to": 7, "start": 5 })", "rmse", 2);
  EXPECT_EQ(first(), 5);
  tuning(R"("stops": { "from": -1, "to": 7 } }, "set": { "stops": 2)", "rmse", 2);
  EXPECT_EQ(first(), 2) << "as the tuning has it";
  const auto j = json::parse(read("t/tuning.json"));
  EXPECT_EQ(j["training"]["before"], (json{{"value", j["steps"][0]["value"]}, {"numbers", j["steps"][0]["numbers"]}}));
}

TEST_F(Tune, GoesOnWhereItWasStopped) {
  ASSERT_EQ(tune({"-o", "whole", "--quiet"}).exit, 0);
  ASSERT_EQ(tune({"-o", "part", "--quiet"}).exit, 0);
  // As if it had been killed in the middle.
  auto journal = json::parse(read("part/journal.json"));
  const auto steps = journal["steps"].size();
  ASSERT_GT(steps, 6u);
  auto& kept = journal["steps"];
  kept.erase(kept.begin() + 5, kept.end());
  write("part/journal.json", journal.dump());
  std::filesystem::remove(path("part/tuning.json"));
  EXPECT_EQ(tune({"-o", "part"}).exit, 2) << "work of an earlier run must not be lost unasked";
  const auto r = tune({"-o", "part", "--resume"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_NE(r.err.find("(known)"), std::string::npos);
  const auto result = [&](const std::string& folder) {
    auto j = json::parse(read(folder + "/tuning.json"));
    EXPECT_EQ(j.erase("command"), 1u);
    return j;
  };
  EXPECT_EQ(result("part"), result("whole"));
  EXPECT_EQ(read("part/variant.json"), read("whole/variant.json"));
}

TEST_F(Tune, AChangedFileIsTriedAnew) {
  ASSERT_EQ(tune({"-o", "t", "--quiet"}).exit, 0);
  for (const char* frame : {"1", "2", "3"}) write_color(std::string("c.000") + frame + ".exr", 16, 8, 0.25f);
  ASSERT_EQ(tune({"-o", "t", "--quiet", "--resume"}).exit, 0);
  EXPECT_NEAR(json::parse(read("t/tuning.json"))["best"]["stops"].get<double>(), 2, 0.01);
}

TEST_F(Tune, StopsWhereTheExpressionIsNoNumber) {
  tuning(R"("stops": { "from": -1, "to": 7 })", "log2(0 - rmse)", 5);
  auto r = tune({"-o", "t", "--quiet"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("the graph itself: 'log2(0 - rmse)' comes to no number\n  rmse is 0.875\n"), std::string::npos)
      << r.err;
  // At 3 stops nothing is left of the error.
  tuning(R"("stops": { "from": -1, "to": 7, "start": 3 })", "1 / rmse", 5);
  r = tune({"-o", "t", "--quiet"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("step 1, stops=3: '1 / rmse' comes to infinity\n  rmse is 0\n"), std::string::npos) << r.err;
  EXPECT_FALSE(std::filesystem::exists(path("t/variant.json")));
}

TEST_F(Tune, SaysWhatIsWrong) {
  const auto expect = [&](const std::string& text) {
    const auto r = tune({"-o", "t"});
    EXPECT_EQ(r.exit, 2) << r.err;
    EXPECT_NE(r.err.find(text), std::string::npos) << r.err;
    EXPECT_FALSE(std::filesystem::exists(path("t/journal.json")));
  };
  tuning(R"("stops": { "from": 3, "to": 3 })", "rmse", 5);
  expect("tune.json:5:28: error: parameters.stops: its range is empty: from 3 to 3");
  tuning(R"("stops": { "from": 0, "to": 3, "scale": "log" })", "rmse", 5);
  expect("a range on a log scale lies above 0, not at 0");
  tuning(R"("stops": { "from": -1e200, "to": 3 })", "rmse", 5);
  expect("parameters.stops: a range lies within ±3.4e+38, not at 1e+200");
  tuning(R"("stops": { "from": 0.2, "to": 0.8, "integer": true })", "rmse", 5);
  expect("parameters.stops: a range of whole numbers has such for ends, not 0.2 and 0.8");
  tuning(R"("stops": { "from": 0, "to": 3, "start": 4 })", "rmse", 5);
  expect("parameters.stops.start: 4 is not between 0 and 3");
  tuning(R"("stops": { "from": 0, "to": 3, "start": 0.5, "integer": true })", "rmse", 5);
  expect("parameters.stops.start: 0.5 is not a whole number");
  tuning(R"("stops": { "from": -1000, "to": 1000 })", "rmse", 5);
  expect("stops: -1000 is not a number from -32 to 32");
  EXPECT_NE(tune({"--check"}).err.find("1000 is not a number from -32 to 32"), std::string::npos);
  tuning(R"("stop": { "from": 0, "to": 3 })", "rmse", 5);
  expect("the graph has no parameter 'stop'");
  tuning(R"("stops": { "from": 0, "to": 3 })", "rmse +", 5);
  expect("minimise: 'rmse +': a number or a name is missing at the end");
  tuning(R"("stops": { "from": 0, "to": 3 })", "3", 5);
  expect("minimise: names no metric");
  tuning(R"("stops": { "from": 0, "to": 3 })", "rmse.most", 5);
  expect("tune.json:6:15: error: minimise: there is no statistic 'most'; there are: mean");
  tuning(R"("stops": { "from": 0, "to": 3 })", "flicker", 5);
  expect("'flicker' reads 'motion'");
  write("tune.json", R"({ "quell_tune": 1, "graph": "brighten.json", "train": ["rooom"], "held_out": [],
    "parameters": { "stops": { "from": 0, "to": 3 } }, "minimise": "rmse" })");
  expect("tune.json:1:56: error: train[0]: there is no sequence 'rooom'");
  expect("tune.json:1:78: error: held_out: is empty; it lists the sequences to tune on");
  tuning(R"("stops": { "from": 0, "to": 3 })", "rmse", 5, "brighten.json", "3,2");
  expect("error: held_out[0]: the search sees frame 2 of 'shot.json' as train[0]");
  tuning(R"("stops": { "from": 0, "to": 3 })", "rmse", 0);
  expect("evaluations: must be a number from 1 to 100000, not 0");
}

}  // namespace
}  // namespace quell::test
