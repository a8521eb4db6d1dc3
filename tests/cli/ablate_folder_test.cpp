// quell ablate: frames that do not fit are refused before anything runs, and a folder holds one study's results.
#include "tests/support/quell_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>

namespace quell::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class AblateFolder : public QuellCommand {
 protected:
  // A study of files, without history.
  void write_shot(const std::string& reference, int reference_width = 16) {
    write("shot.json", fmt::format(R"({{"quell_sequence": 1, "frames": "1-3", "root": "shot",
        "inputs": {{"color": {{"file": "c.####.exr"}}}}, "reference": {{"file": "{}"}}}})",
                                   reference));
    for (int f = 1; f <= 3; ++f) {
      write_color(fmt::format("shot/c.{:04}.exr", f), 16, 8, float(f));
      write_color(fmt::format("shot/r.{:04}.exr", f), reference_width, 8, 2);
    }
    write_study("shot.json", "{}");
  }
  void write_study(const std::string& sequence, const std::string& variants, const std::string& more = "") {
    write("study.json",
          fmt::format(R"({{"quell_study": 1, "name": "files", "graph": "unfiltered", "sequences": ["{}"{}],
        "metrics": ["mse"], "warm_up": 0, "variants": {}}})",
                      sequence, more, variants));
  }
  ProgramResult ablate(std::vector<std::string> args = {}) {
    return quell(std::vector<std::string>{"ablate", "./study.json", "-o", "out", "--quiet"} + args);
  }
  // --check finds it too, and neither leaves anything behind.
  void expect_refused(const std::string& text) {
    for (const bool check : {true, false}) {
      const auto r = ablate(check ? std::vector<std::string>{"--check"} : std::vector<std::string>{});
      EXPECT_EQ(r.exit, 3);
      EXPECT_NE(r.err.find(text), std::string::npos) << r.err;
      EXPECT_FALSE(fs::exists(path("out")));
    }
  }
};

TEST_F(AblateFolder, RefusesAReferenceThatNoFrameHas) {
  write_shot("gone/r.####.exr");
  expect_refused(
      "study.json:2:21: error: metrics[0]: 'mse' judges by a reference, and no frame of 'shot' has all its files\n"
      "  frames are 1-3; of the first it would be shot/gone/r.0001.exr\n");
}

TEST_F(AblateFolder, RefusesAReferenceOfAnotherSize) {
  write_shot("r.####.exr", 20);
  expect_refused(
      "the images of the sequence 'shot' do not fit each other: in frame 1 color is 16x8, reference is 20x8\n");
}

TEST_F(AblateFolder, SaysHowToGoOnWithoutAMissingFrame) {
  write_shot("r.####.exr");
  fs::remove(path("shot/c.0002.exr"));
  expect_refused(
      "c.0002.exr: there is no such file\n  of the sequence 'shot'; \"frames\" beside its \"path\" picks others\n");
}

TEST_F(AblateFolder, CostsAreThoseOfEachSequence) {
  write_shot("r.####.exr");
  write_study("shot.json", "{}", R"(, {"path": "shot.json", "name": "again", "frames": "1-2"})");
  ASSERT_EQ(ablate().exit, 0);
  const auto times = json::parse(read("out/timings.json"))["variants"][0];
  const double first = times["cost_ms_of"]["shot"], second = times["cost_ms_of"]["again"];
  EXPECT_NEAR(times["cost_ms"].get<double>(), (3 * first + 2 * second) / 5, 1e-9);
}

TEST_F(AblateFolder, HoldsNothingOfEarlierResults) {
  write_shot("r.####.exr");
  write_study("shot.json", R"({"first": {"graph": "gaussian"}})");
  ASSERT_EQ(ablate().exit, 0);
  ASSERT_TRUE(fs::exists(path("out/images/shot/first.0001.exr")));
  write("out/images/shot/mine.exr", "not Quell's");
  write_study("shot.json", R"({"second": {"graph": "gaussian"}})");
  for (const auto* how : {"--resume", "--restart"}) {
    ASSERT_EQ(ablate({how}).exit, 0);
    EXPECT_FALSE(fs::exists(path("out/images/shot/first.0001.exr")));
    EXPECT_FALSE(fs::exists(path("out/variants/first.json")));
    EXPECT_TRUE(fs::exists(path("out/images/shot/second.0001.exr")));
    EXPECT_TRUE(fs::exists(path("out/variants/second.json")));
    EXPECT_TRUE(fs::exists(path("out/images/shot/mine.exr")));
  }
}

TEST_F(AblateFolder, IsHeldByOneRun) {
  write("study.json", R"({"quell_study": 1, "name": "long", "graph": "svgf", "metrics": ["flicker"],
      "sequences": [{"path": "room", "frames": "0-31", "source": {"width": 96, "height": 54, "spp": 16},
                     "reference": {"width": 96, "height": 54, "spp": 1}}]})");
  Program first(command({"ablate", "./study.json", "-o", "out", "--threads", "1"}), here());
  ASSERT_TRUE(first.wait_until([&] { return fs::exists(path("out/journal")); }));
  const auto second = ablate({"--resume"});
  EXPECT_EQ(second.exit, 2);
  EXPECT_NE(second.err.find("another run is at work in out\n"), std::string::npos) << second.err;
  first.send(SIGKILL);
  first.finish();
  EXPECT_EQ(ablate({"--restart", "--check"}).exit, 0);
}

TEST_F(AblateFolder, MakesADamagedReferenceAnew) {
  write("study.json", R"({"quell_study": 1, "name": "kept", "graph": "unfiltered", "metrics": ["mse"], "warm_up": 0,
      "sequences": [{"path": "room", "frames": "0-1", "source": {"width": 24, "height": 16},
                     "reference": {"width": 24, "height": 16, "spp": 2}}]})");
  ASSERT_EQ(ablate().exit, 0);
  const auto results = read("out/results.json");
  std::size_t damaged = 0;
  for (const auto& entry : fs::recursive_directory_iterator(path("out/references")))
    if (entry.is_regular_file()) fs::resize_file(entry.path(), 100), ++damaged;
  EXPECT_EQ(damaged, 4u);
  ASSERT_EQ(ablate({"--restart"}).exit, 0);
  EXPECT_EQ(read("out/results.json"), results);
}

}  // namespace
}  // namespace quell::test
