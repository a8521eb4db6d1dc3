// Runs over files that are missing, change their size, end too early or lack a channel.
#include "tests/support/paths.h"
#include "tests/support/quell_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace quell::test {
namespace {

namespace fs = std::filesystem;

class Sequences : public QuellCommand {
 protected:
  void SetUp() override {
    // What came in, and what came in one frame before: it shows where history ends.
    write("past.json", R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {},
                           "outputs": {"now": "color", "before": "color@-1"}})");
    write("shot.json", R"({"quell_sequence": 1, "frames": "1-5", "inputs": {"color": {"file": "in/c.####.exr"}}})");
    for (int f = 1; f <= 5; ++f) frame(f);
  }
  static std::string input(int f) { return fmt::format("in/c.{:04}.exr", f); }
  void frame(int f, int width = 16, int height = 8) { write_color(input(f), width, height, float(f)); }
  ProgramResult run(std::vector<std::string> args = {}) {
    fs::remove_all(path("out"));
    return quell(std::vector<std::string>{"run", "past.json", "shot.json", "--quiet"} + args);
  }
  // "1(0) 2(1)": what came in and, in brackets, what was remembered, for each frame that was written.
  std::string story() {
    std::string out;
    for (const auto& name : files("out")) {
      if (!name.starts_with("now.")) continue;
      const auto before = "before" + name.substr(3);
      out += fmt::format("{}{}({})", out.empty() ? "" : " ", value("out/" + name), value("out/" + before));
    }
    return out;
  }
  float value(const std::string& name) {
    const auto p = pixels(name);
    for (const auto& [channel, plane] : p.channels)
      for (const float v : plane) EXPECT_EQ(v, plane[0]) << name << ' ' << channel;
    return p.channels.at("R")[0];
  }
};

TEST_F(Sequences, RunWhole) {
  const auto r = run();
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(r.out, "");
  EXPECT_EQ(story(), "1(0) 2(1) 3(2) 4(3) 5(4)");
  EXPECT_EQ(run({"--frames", "2-4"}).exit, 0);
  EXPECT_EQ(story(), "2(0) 3(2) 4(3)");
  EXPECT_EQ(run({"--frames", "1,2,4,5"}).exit, 0);
  EXPECT_EQ(story(), "1(0) 2(1) 4(0) 5(4)") << "history ends at a gap";
}

TEST_F(Sequences, AMissingFrameIsAnErrorUnlessSaidOtherwise) {
  fs::remove(path(input(3)));
  const auto r = run();
  EXPECT_EQ(r.exit, 3);
  EXPECT_EQ(r.err,
            "quell: error: frame 3: color: in/c.0003.exr: there is no such file\n"
            "  --missing skip, hold or black goes on without\n");
  EXPECT_EQ(story(), "") << "it is noticed before the first frame";
  EXPECT_EQ(run({"--missing", "skip"}).exit, 0);
  EXPECT_EQ(story(), "1(0) 2(1) 4(0) 5(4)");
  EXPECT_EQ(run({"--missing", "hold"}).exit, 0);
  EXPECT_EQ(story(), "1(0) 2(1) 2(2) 4(2) 5(4)");
  EXPECT_EQ(run({"--missing", "black"}).exit, 0);
  EXPECT_EQ(story(), "1(0) 2(1) 0(0) 4(0) 5(4)");
  EXPECT_EQ(run({"--frames", "7-9", "--missing", "skip"}).exit, 3) << "nothing is left";
}

TEST_F(Sequences, AnotherSizeBeginsHistoryAnew) {
  frame(3, 20, 6), frame(4, 20, 6);
  const auto r = run();
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err,
            "warning: frame 3 has another size than the frame before: its history began anew\n"
            "warning: frame 5 has another size than the frame before: its history began anew\n");
  EXPECT_EQ(story(), "1(0) 2(1) 3(0) 4(3) 5(0)");
  for (const auto& [f, width, height] : {std::tuple{2, 16, 8}, {3, 20, 6}, {4, 20, 6}, {5, 16, 8}}) {
    const auto p = pixels(fmt::format("out/before.{:04}.exr", f));
    EXPECT_EQ(p.width, width) << f;
    EXPECT_EQ(p.height, height) << f;
  }
}

TEST_F(Sequences, ATruncatedFrameEndsTheRunBehindWhatIsDone) {
  fs::resize_file(path(input(4)), fs::file_size(path(input(4))) * 2 / 3);
  const auto r = run();
  EXPECT_EQ(r.exit, 3);
  EXPECT_EQ(r.err.find("quell: error: frame 4: in/c.0004.exr: "), 0u) << r.err;
  EXPECT_NE(r.err.find("\n  written before: frames 1-3\n"), std::string::npos) << r.err;
  EXPECT_EQ(story(), "1(0) 2(1) 3(2)");
  for (const auto& name : files("out")) EXPECT_NE(name[0], '.') << "a temporary file is left: " << name;
  write(input(4), "not an image at all");
  EXPECT_EQ(run().exit, 3);
  EXPECT_EQ(story(), "1(0) 2(1) 3(2)");
  fs::remove(path(input(4)));
  fs::create_directories(path(input(4)));
  EXPECT_EQ(run().exit, 3);
}

TEST_F(Sequences, AnUnknownChannelIsNamedWithThoseThatAre) {
  write("shot.json", R"({"quell_sequence": 1, "frames": "1-5",
    "inputs": {"color": {"file": "in/c.####.exr", "channels": ["R", "g", "B"]}}})");
  const auto r = run();
  EXPECT_EQ(r.exit, 2);
  EXPECT_EQ(r.err,
            "shot.json:2:63: error: inputs.color: 'in/c.0001.exr' has no channel 'g'\n"
            "  it has: R, G, B. Did you mean 'G'?\n");
  write("depth.json", R"({"quell": 1, "inputs": {"depth": "depth"}, "nodes": {}, "outputs": {"d": "depth"}})");
  const auto role = quell({"run", "depth.json", "shot.json"});
  EXPECT_EQ(role.exit, 2);
  EXPECT_EQ(role.err.find("depth.json:1:25: error: inputs.depth: the sequence has no 'depth'\n  it has: color"), 0u)
      << role.err;
}

TEST_F(Sequences, RootMovesTheFiles) {
  fs::create_directories(path("elsewhere"));
  fs::rename(path("in"), path("elsewhere/in"));
  EXPECT_EQ(run().exit, 3);
  EXPECT_EQ(run({"--root", "elsewhere"}).exit, 0);
  EXPECT_EQ(story(), "1(0) 2(1) 3(2) 4(3) 5(4)");
  EXPECT_EQ(run({"--root", path("elsewhere")}).exit, 0);
}

TEST_F(Sequences, RepairsAreWarnedAbout) {
  write_color(input(2), 16, 8, -1.0f);
  const auto r = run();
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err, "warning: color: 128 pixels were negative and have been raised to 0\n");
  EXPECT_EQ(story(), "1(0) 0(1) 3(0) 4(3) 5(4)");
}

TEST_F(Sequences, MessagesSayNoMoreOfAPathThanTheUserDid) {
  fs::remove(path(input(3)));
  write("typo.json", R"({"quell": 1, "inputs": {}, "nodes": {}, "outputs": {"a": "b"}})");
  write("typo_shot.json", R"({"quell_sequence": 1, "framse": "1-5", "inputs": {"color": "in/c.####.exr"}})");
  for (const auto& args :
       std::vector<std::vector<std::string>>{{"run", "past.json", "shot.json"},
                                             {"check", "typo.json"},
                                             {"check", "./past.json", "typo_shot.json"},
                                             {"check", "past.json", "nothing.json"},
                                             {"run", "past.json", "in/d.####.exr"},
                                             {"run", "past.json", "room", "-o", "past.json/c.####.exr"}}) {
    const auto r = quell(args);
    EXPECT_NE(r.exit, 0);
    EXPECT_EQ((r.err + r.out).find(path("")), std::string::npos) << r.err;
    EXPECT_EQ((r.err + r.out).find(QUELL_TEST_SOURCE), std::string::npos) << r.err;
  }
}

}  // namespace
}  // namespace quell::test
