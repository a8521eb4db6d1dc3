// Pictures say how they were made, and are made again from that alone.
#include "tests/support/paths.h"
#include "tests/support/quell_command.h"

#include "core/image/image.h"
#include "core/sequence/image_file.h"
#include "core/sequence/image_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace quell::test {
namespace {

namespace fs = std::filesystem;

class Rerun : public QuellCommand {
 protected:
  void expect_identical(const std::string& frame, const std::string& frames, std::vector<std::string> args = {}) {
    SCOPED_TRACE(frame);
    const auto r = quell(std::vector<std::string>{"rerun", frame} + args);
    EXPECT_EQ(r.exit, 0) << r.out << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_EQ(r.out, fmt::format("{}: identical, bit for bit; made again from frames {}\n", frame, frames));
  }
  void expect(int exit, const ProgramResult& r, const std::string& text) {
    EXPECT_EQ(r.exit, exit) << r.out << r.err;
    EXPECT_NE((r.out + r.err).find(text), std::string::npos) << text << "\nin\n" << r.out << r.err;
  }
  std::string attribute(const std::string& file, const std::string& name) {
    return ImageFile(path(file)).texts()[name];
  }
  // A sequence of files whose history shows in what comes out, under a folder that can be moved.
  void write_shot() {
    write("past.json", R"({"quell": 1, "name": "past", "inputs": {"color": "radiance"}, "nodes": {
      "both": {"type": "sum", "in": {"images": ["color", {"from": "both@-1", "start": "color"}]}}}, "outputs": {"now": "both"}})");
    write("shot.json", R"({"quell_sequence": 1, "frames": "1-9", "cuts": [4], "root": "shot",
                           "inputs": {"color": {"file": "in/c.####.exr", "scale": 0.5}}})");
    for (int f = 1; f <= 9; ++f) write_color(fmt::format("shot/in/c.{:04}.exr", f), 16, 8, float(f));
  }
  ProgramResult run_shot(std::vector<std::string> args = {}) {
    return quell(std::vector<std::string>{"run", "past.json", "shot.json", "--quiet", "-o", "now.####.exr"} + args);
  }
};

TEST_F(Rerun, MakesTheSameBitsOfTheRoom) {
  auto r = run_room("svgf", {"--quiet", "-o", "c.####.exr", "--tap", "age", "--tap", "level0.atrous.image", "--preview",
                             "--set", "alpha=0.3", "--bypass", "level4", "--threads", "2"});
  ASSERT_EQ(r.exit, 0) << r.err;
  expect_identical("c.0003.exr", "0-3");
  expect_identical("c.0000.exr", "0");
  expect_identical("age.0002.exr", "0-2", {"--threads", "1"});
  expect_identical("level0.atrous.image.0001.exr", "0-1");
  expect(2, quell({"rerun", "c.0003.png"}),
         "c.0003.png: is a preview of 'color'; give the image that it was made beside");

  ASSERT_EQ(run_room("svgf", {"--quiet", "-o", "d.####.exr", "--float", "--compression", "zips:9"}).exit, 0);
  expect_identical("d.0001.exr", "0-1", {"-o", "again.exr"});
  EXPECT_EQ(pixels("again.exr"), pixels("d.0001.exr"));
  expect_identical("again.exr", "0-1");
  ASSERT_EQ(run_room("svgf", {"--quiet", "-o", "e.####.exr", "--compression", "dwaa:200"}).exit, 0);
  expect_identical("e.0001.exr", "0-1");
  ASSERT_EQ(run_room("svgf", {"--quiet", "-o", "f.####.png", "--simd", "scalar"}).exit, 0);
  expect_identical("f.0001.png", "0-1");
}

TEST_F(Rerun, AttributesSayItAll) {
  ASSERT_EQ(run_room("svgf", {"--quiet", "-o", "it's.####.exr", "--report", "report.json"}).exit, 0);
  const std::string file = "it's.0002.exr";
  EXPECT_EQ(attribute(file, "quell:frames"), "0-2");
  EXPECT_NE(attribute(file, "quell:command").find("run svgf room"), std::string::npos);
  EXPECT_NE(attribute(file, "quell:command").find(R"(-o 'it'\''s.####.exr')"), std::string::npos);
  EXPECT_NE(attribute(file, "quell:plugins").find("atrous "), std::string::npos);
  EXPECT_NE(attribute(file, "quell:plugins").find("path_tracer "), std::string::npos);
  EXPECT_EQ(attribute(file, "quell:fingerprint").size(), 16u);
  EXPECT_NE(attribute(file, "quell:inputs").find("\"source.scene\""), std::string::npos);
  EXPECT_NE(attribute(file, "quell:sequence").find("\"scene\":\"quell:scenes/room.json\""), std::string::npos)
      << "not where it is installed: " << attribute(file, "quell:sequence");
  // The graph and the sequence in it are files that run.
  write("graph.json", attribute(file, "quell:graph"));
  write("shot.json", attribute(file, "quell:sequence"));
  const auto r = quell({"run", "graph.json", "shot.json", "--quiet", "-o", "own.####.exr"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(pixels("own.0003.exr"), pixels("it's.0003.exr"));
  const auto report = nlohmann::json::parse(read("report.json")).at("provenance");
  EXPECT_EQ(report.at("fingerprint"), attribute(file, "quell:fingerprint"));
  EXPECT_EQ(report.at("graph"), nlohmann::json::parse(attribute(file, "quell:graph")));
  EXPECT_EQ(report.at("inputs").at("2"), nlohmann::json::parse(attribute(file, "quell:inputs")));
  EXPECT_EQ(report.at("command"), attribute(file, "quell:command"));
}

TEST_F(Rerun, SaysWhichFilesHaveChanged) {
  write_shot();
  ASSERT_EQ(run_shot().exit, 0);
  expect_identical("now.0003.exr", "1-3");
  expect_identical("now.0006.exr", "4-6");  // history began at the cut
  const auto good = read("shot/in/c.0003.exr");
  write_color("shot/in/c.0003.exr", 16, 8, 3.5f);
  auto r = quell({"rerun", "now.0003.exr"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_EQ(r.out,
            "now.0003.exr: differs: 128 of 128 pixels, by at most 0.25: R of pixel (0, 0) was 3.5, now 3.75\n"
            "  frame 3: in/c.0003.exr has changed\n");
  expect_identical("now.0002.exr", "1-2");
  write("shot/in/c.0003.exr", good);
  write_color("shot/in/c.0001.exr", 16, 8, 7);
  expect(1, quell({"rerun", "now.0003.exr"}), "\n  frame 1: in/c.0001.exr has changed\n");
  expect_identical("now.0006.exr", "4-6");
}

TEST_F(Rerun, MissingFilesAreNamedAndMayLieElsewhere) {
  write_shot();
  ASSERT_EQ(run_shot().exit, 0);
  fs::rename(path("shot"), path("moved"));
  const auto r = quell({"rerun", "now.0003.exr"});
  expect(3, r, "shot/in/c.0001.exr: there is no such file");
  expect(3, r, "\n  --root FOLDER says where its files are now; they were in ");
  expect_identical("now.0003.exr", "1-3", {"--root", "moved"});
  expect(3, quell({"rerun", "no.exr"}), "no.exr: there is no such file");
  expect(2, quell({"rerun", "now.0003.exr", "--root", "moved", "-o", "now.0003.exr"}), "is a file that is read");
  expect(2, quell({"rerun", "now.0003.exr", "--root", "moved", "-o", "moved/in/c.0002.exr"}), "is a file that is read");
  expect(2, quell({"rerun", "now.0003.exr", "--root", "moved", "-o", "a.png"}), "must end as now.0003.exr does");
}

TEST_F(Rerun, HeldAndBlackFramesAreWhatTheyWere) {
  write_shot();
  fs::remove(path("shot/in/c.0006.exr"));
  for (const std::string missing : {"hold", "black", "skip"}) {
    SCOPED_TRACE(missing);
    ASSERT_EQ(run_shot({"--missing", missing}).exit, 0);
    expect_identical("now.0007.exr", missing == "hold" ? "4-7" : "7");
    if (missing != "skip") expect_identical("now.0006.exr", missing == "hold" ? "4-6" : "6");
  }
}

TEST_F(Rerun, ChunksGoOnFromTheirState) {
  write_shot();
  ASSERT_EQ(run_shot({"--frames", "4-6", "--save-state", "a.state"}).exit, 0);
  ASSERT_EQ(run_shot({"--frames", "7-9", "--load-state", "a.state"}).exit, 0);
  expect_identical("now.0008.exr", "7-8");
  const auto state = read("a.state");
  write("a.state", state.substr(0, state.size() - 1) + "x");
  expect(3, quell({"rerun", "now.0008.exr"}), "a.state: is not the saved state that the run went on from");
  fs::remove(path("a.state"));
  expect(3, quell({"rerun", "now.0008.exr"}), "a.state: the saved state that the run went on from is not there");
}

TEST_F(Rerun, NeedsNotTheGraphFilesOfThen) {
  write_shot();
  ASSERT_EQ(run_shot().exit, 0);
  write("past.json", "{");
  fs::remove(path("shot.json"));
  expect_identical("now.0003.exr", "1-3");
}

TEST_F(Rerun, SaysWhichPluginIsAnother) {
#ifdef QUELL_TEST_STATIC_PLUGINS
  GTEST_SKIP() << "the plugins are linked into the program";
#endif
  write("trips.json", R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {
    "t": {"type": "trips", "in": {"image": "color"}, "set": {"frame": 1000}}}, "outputs": {"color": "t"}})");
  const std::string folder = QUELL_TEST_TRIPS;
  ASSERT_EQ(run_room("trips.json", {"--quiet", "-o", "c.####.exr", "--plugins", folder}).exit, 0);
  expect_identical("c.0000.exr", "0", {"--plugins", folder});
  const auto r = quell({"rerun", "c.0000.exr", "--plugins", folder + "_newer"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_NE(r.out.find("c.0000.exr: differs: "), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("\n  plugin trips 1.0 was there, now trips 1.1\n"), std::string::npos) << r.out;
  expect(2, quell({"rerun", "c.0000.exr"}), "there is no node type 'trips'");
}

class Damaged : public Rerun {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_room("unfiltered", {"--quiet", "-o", "c.####.exr"}).exit, 0);
    texts_ = ImageFile(path("c.0001.exr")).texts();
  }
  ProgramResult with(const std::string& key, const std::string& text) {
    WriteOptions options;
    options.metadata = texts_;
    options.metadata[key] = text;
    Image image(quell_shape{64, 36, 3});
    const quell_image view = image.view();
    for (int c = 0; c < 3; ++c) std::fill_n(view.plane[c], 36 * view.pitch, 0.0f);
    write_image(path("bad.exr"), view, QUELL_RADIANCE, options);
    return quell({"rerun", "bad.exr"});
  }
  std::map<std::string, std::string> texts_;
};

TEST_F(Damaged, AttributesAreErrorsWithAPlace) {
  write_color("plain.exr", 4, 4, 1);
  expect(2, quell({"rerun", "plain.exr"}), "plain.exr: does not say how it was made");
  expect(1, with("quell:version", "0.0.1"), "Quell was 0.0.1, now ");
  expect(2, with("quell:graph", "not json"), "bad.exr (quell:graph):1:");
  expect(2, with("quell:graph", std::string(1 << 20, '[')), "bad.exr (quell:graph):1:");
  expect(2, with("quell:graph", std::string((1 << 26) + 1, ' ')), "its attribute 'quell:graph' has 67108865 bytes");
  expect(2, with("quell:graph", R"({"quell": 1, "nodes": {"a": {"graph": "/etc/passwd"}}, "outputs": {"color": "a"}})"),
         "leads out of the folder of its graph");
  expect(2, with("quell:sequence", "{}"), "bad.exr (quell:sequence):1:1: error: ");
  expect(2, with("quell:sequence", ""), "its attribute 'quell:sequence' is empty");
  expect(2, with("quell:frames", "3-1"), "its attribute 'quell:frames' is ");
  expect(2, with("quell:frames", "0-99999999999"), "its attribute 'quell:frames' is no range: ");
  expect(2, with("quell:frames", "0,2"), "which has gaps");
  expect(2, with("quell:inputs", "[1]"), "its attribute 'quell:inputs' is ");
  expect(2, with("quell:inputs", R"({"a": 1})"), "its attribute 'quell:inputs' has 1 for a hash");
  expect(2, with("quell:files", R"([1])"), "its attribute 'quell:files' holds 1");
  expect(2, with("quell:output", "{}"), "its attribute 'quell:output' has no text \"name\"");
  expect(2, with("quell:output", R"({"name": "shade", "half": true, "compression": "zip"})"),
         "its graph has no output 'shade'");
  expect(2, with("quell:output", R"({"name": "color", "half": true, "compression": "ace"})"),
         "names the compression 'ace', which there is not");
  expect(2, with("quell:missing", "shrug"), "its attribute 'quell:missing' is 'shrug'");
  expect(3, with("quell:state", R"({"file": "/no/such.state", "hash": "0"})"), "/no/such.state: the saved state");
  expect(5, with("quell:simd", "abacus"), "it was made with 'abacus'");
  // All is well, but these are not the pixels that it makes.
  expect(1, with("quell:frames", "0-1"), "bad.exr: differs: ");
}

}  // namespace
}  // namespace quell::test
