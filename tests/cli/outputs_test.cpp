// What a run writes: images, previews, progress and reports.
#include "core/report/error.h"
#include "tests/support/quell_command.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

namespace quell::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Outputs : public QuellCommand {
 protected:
  void SetUp() override {
    for (int f = 1; f <= 3; ++f) write_color(fmt::format("c.{:04}.exr", f), 40, 20, 0.3f * float(f));
    write("shot.json", R"({"quell_sequence": 1, "frames": "1-3", "inputs": {"color": {"file": "c.####.exr"}}})");
    write("pass.json", R"({"quell": 1, "inputs": {"color": "radiance"},
      "nodes": {"clamp": {"type": "outlier_clamp", "in": {"image": "color"}}}, "outputs": {"color": "clamp"}})");
  }
  ProgramResult run(std::vector<std::string> args, ProgramOptions options = {}) {
    return quell(std::vector<std::string>{"run", "pass.json", "shot.json"} + args, std::move(options));
  }
};

TEST_F(Outputs, GoToTheFolderOutWhenNothingIsSaid) {
  const auto r = run({});
  EXPECT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(r.out, "");
  EXPECT_EQ(r.err.find("3 frames in "), 0u) << r.err;
  EXPECT_NE(r.err.find("\ncolor: out/color.####.exr\n"), std::string::npos) << r.err;
  EXPECT_EQ(files("out"), (std::vector<std::string>{"color.0001.exr", "color.0002.exr", "color.0003.exr"}));
  EXPECT_TRUE(pixels("out/color.0001.exr").half);
  EXPECT_EQ(pixels("out/color.0002.exr").width, 40);
}

TEST_F(Outputs, OneFrameNeedsNoNumber) {
  EXPECT_EQ(run({"--frames", "2", "-o", "a=b.exr"}).exit, 2) << "NAME=PATTERN";
  EXPECT_EQ(run({"--frames", "2", "-o", "./a=b.exr", "--quiet"}).exit, 0);
  EXPECT_EQ(pixels("a=b.exr").height, 20);
}

TEST_F(Outputs, QuietPrintsNothing) {
  const auto r = run({"--quiet"});
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err + r.out, "");
}

TEST_F(Outputs, FloatsAreFloats) {
  EXPECT_EQ(run({"--float", "--quiet"}).exit, 0);
  const auto p = pixels("out/color.0001.exr");
  EXPECT_FALSE(p.half);
  EXPECT_EQ(p.channels.at("R")[0], pixels("c.0001.exr").channels.at("R")[0]);
}

TEST_F(Outputs, PreviewsAreEncoded) {
  EXPECT_EQ(run({"--preview", "--quiet", "-o", "p/x.####.exr"}).exit, 0);
  EXPECT_EQ(files("p").size(), 6u);
  const auto p = pixels("p/x.0001.png");
  EXPECT_EQ(p.width, 40);
  const double linear = double(pixels("p/x.0001.exr").channels.at("G")[0]);
  EXPECT_NEAR(p.channels.at("G")[0], 1.055 * std::pow(linear, 1 / 2.4) - 0.055, 0.51 / 255);
}

TEST_F(Outputs, EveryTypeThatAnEyeCanReadHasAPreview) {
  const auto r = run({"--preview", "--quiet", "--frames", "2", "--tap", "clamp.image", "-o", "p/x.exr"});
  EXPECT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(files("p"), (std::vector<std::string>{"clamp.image.0002.exr", "clamp.image.0002.png", "x.exr", "x.png"}));
  const auto room =
      quell({"run",      "svgf",          "room",    "--frames",   "1",     "--source", "width=32",
             "--source", "height=24",     "--quiet", "--preview",  "--tap", "depth",    "--tap",
             "id",       "--tap",         "motion",  "--tap",      "age",   "--tap",    "variance.variance",
             "--tap",    "validity.taps", "-o",      "r/color.exr"});
  EXPECT_EQ(room.exit, 0) << room.err;
  for (const char* name : {"color", "depth.0001", "id.0001", "motion.0001", "age.0001", "variance.variance.0001"})
    EXPECT_EQ(pixels(std::string("r/") + name + ".png").width, 32) << name;
  EXPECT_FALSE(fs::exists(path("r/validity.taps.0001.png"))) << "five numbers and bits a pixel are no picture";
}

TEST_F(Outputs, PreviewsOfRadianceCanBeChosen) {
  EXPECT_EQ(run({"--preview-graph", "exposed", "--preview-set", "operator=reinhard", "--quiet", "--frames", "1", "-o",
                 "p/x.exr"})
                .exit,
            0);
  const auto& shown = pixels("p/x.png").channels;
  // Of a frame of one colour 0.3, 0.3, 0.3: its luminance becomes 0.18, and v / (1 + Y).
  const double luminance = 0.18;
  EXPECT_NEAR(shown.at("R")[5], 1.055 * std::pow(luminance / (1 + luminance), 1 / 2.4) - 0.055, 0.51 / 255);
  EXPECT_EQ(run({"--preview-set", "stops=1", "--quiet", "--frames", "1", "-o", "s/x.exr"}).exit, 0);
  EXPECT_NEAR(pixels("s/x.png").channels.at("R")[5], 1.055 * std::pow(0.6, 1 / 2.4) - 0.055, 0.51 / 255);
  const auto r = run({"--preview-graph", "expose"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_EQ(r.err,
            "quell: error: --preview-graph expose: there is no such preview\n"
            "  installed are: exposed, ocio, radiance; others are files, named with their folder or with .json\n");
}

TEST_F(Outputs, PreviewsAreNoPartOfTheState) {
  EXPECT_EQ(run({"--preview", "--quiet", "--frames", "1", "--save-state", "s", "-o", "a/x.####.exr"}).exit, 0);
  EXPECT_EQ(run({"--quiet", "--frames", "2", "--load-state", "s", "-o", "a/x.####.exr"}).exit, 0);
}

TEST_F(Outputs, EachCompressionWorks) {
  EXPECT_EQ(run({"--quiet", "--compression", "none", "-o", "none.####.exr"}).exit, 0);
  const auto reference = pixels("none.0002.exr");
  for (const std::string compression : {"zips", "zip", "piz", "rle"}) {
    EXPECT_EQ(run({"--quiet", "--compression", compression, "-o", compression + ".####.exr"}).exit, 0) << compression;
    EXPECT_EQ(pixels(compression + ".0002.exr"), reference) << compression;
    EXPECT_NE(read(compression + ".0002.exr"), read("none.0002.exr")) << compression;
  }
  for (const std::string compression : {"dwaa", "pxr24"}) {
    EXPECT_EQ(run({"--quiet", "--compression", compression, "-o", compression + ".####.exr"}).exit, 0) << compression;
    EXPECT_NEAR(pixels(compression + ".0002.exr").channels.at("B")[7], reference.channels.at("B")[7], 1e-2)
        << compression;
  }
}

TEST_F(Outputs, NeverReplaceWhatIsRead) {
  const auto before = read("c.0002.exr");
  for (const char* pattern : {"c.####.exr", "./c.%04d.exr", "x/../c.@@@@.exr"}) {
    const auto r = run({"-o", pattern});
    EXPECT_EQ(r.exit, 2) << pattern;
    EXPECT_NE(r.err.find("the sequence's 'color' and output 'color' would both be "), std::string::npos) << r.err;
  }
  EXPECT_EQ(read("c.0002.exr"), before);
}

TEST_F(Outputs, AFolderThatCannotBeIsRefusedBeforeTheRun) {
  const auto r = run({"-o", "pass.json/deep/c.####.exr"});
  EXPECT_EQ(r.exit, 5);
  EXPECT_EQ(r.err, "quell: error: cannot write 'pass.json/deep/c.0001.exr': 'pass.json' is no folder\n");
  for (const std::string option : {"--save-state", "--report"}) {
    const auto file = run({option, "pass.json/file"});
    EXPECT_EQ(file.exit, 5) << option;
    EXPECT_EQ(file.err, "quell: error: cannot write 'pass.json/file': 'pass.json' is no folder\n");
    EXPECT_EQ(run({option, "/dev/null"}).err,
              "quell: error: cannot write '/dev/null': it is a device or pipe, not a file\n");
    EXPECT_EQ(run({option, "."}).err, "quell: error: cannot write '.': Is a directory\n");
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_FALSE(fs::exists(path("out"))) << "nothing has run";
}

TEST_F(Outputs, AFileThatGrowsTooLargeIsNotLeftHalf) {
  const auto r = run({"--compression", "none"}, {.file_bytes = 1000});
  EXPECT_EQ(r.exit, 5) << r.err;
  EXPECT_EQ(r.signal, 0);
  EXPECT_NE(r.err.find("cannot write 'out/color.0001.exr': File too large"), std::string::npos) << r.err;
  EXPECT_TRUE(files("out").empty());
}

TEST_F(Outputs, LinksStayLinks) {
  fs::create_directories(path("disk"));
  fs::create_directories(path("out"));
  fs::create_symlink("../disk/c1.exr", path("out/color.0001.exr"));
  EXPECT_EQ(run({"--quiet"}).exit, 0);
  EXPECT_TRUE(fs::is_symlink(path("out/color.0001.exr")));
  EXPECT_EQ(pixels("disk/c1.exr").width, 40);
}

TEST_F(Outputs, ProgressIsJsonALine) {
  const auto r = run({"--progress", "json"});
  EXPECT_EQ(r.exit, 0);
  std::istringstream lines(r.err);
  int done = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto j = json::parse(line);
    EXPECT_EQ(j["done"], ++done);
    EXPECT_EQ(j["frame"], done);
    EXPECT_EQ(j["total"], 3);
    EXPECT_GT(j["frames_per_second"], 0);
    EXPECT_GE(j["seconds_left"], 0);
  }
  EXPECT_EQ(done, 3);
  EXPECT_EQ(run({"--progress", "json", "--quiet"}).err, "");
}

TEST_F(Outputs, TheReportHasItsKeys) {
  EXPECT_EQ(run({"--quiet", "--report", "deep/report.json", "--threads", "2"}).exit, 0);
  const auto j = json::parse(read("deep/report.json"));
  EXPECT_EQ(j["quell_report"], 1);
  EXPECT_EQ(j["frames"], 3);
  EXPECT_EQ(j["threads"], 2);
  EXPECT_EQ(j["resets"], 1);
  EXPECT_EQ(j["fingerprint"].get<std::string>().size(), 16u);
  EXPECT_GT(j["seconds"], 0);
  EXPECT_GT(j["image_bytes"], 40 * 20 * 3 * 4);
  EXPECT_GT(j["peak_bytes"], j["image_bytes"]);
  for (const char* part : {"read", "filter", "write"}) {
    EXPECT_GE(j[part]["ms_per_frame"], 0) << part;
    EXPECT_TRUE(j[part].contains("cpu_ms_per_frame")) << part;
  }
  ASSERT_EQ(j["nodes"].size(), 1u);
  EXPECT_EQ(j["nodes"][0]["name"], "clamp");
  EXPECT_EQ(j["nodes"][0]["type"], "outlier_clamp");
  EXPECT_TRUE(j["nodes"][0].contains("ms_per_frame"));
  EXPECT_TRUE(j.contains("graph"));
  EXPECT_TRUE(j.contains("simd"));

  EXPECT_TRUE(j["values"].empty());

  const auto out = run({"--quiet", "--report", "-"});
  EXPECT_EQ(json::parse(out.out)["frames"], 3);
  EXPECT_EQ(out.err, "");
  EXPECT_EQ(run({"--quiet", "--report", "-"}, {.out = "/dev/full"}).exit, 5);
}

TEST_F(Outputs, TimesAreATable) {
  const auto r = run({"--quiet", "--times"});
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err.find("node "), 0u) << r.err;
  EXPECT_NE(r.err.find("outlier_clamp"), std::string::npos) << r.err;
  EXPECT_EQ(r.out, "");
}

// A number a frame is no image: it goes to the report.
TEST_F(Outputs, ValuesAreReported) {
  write("values.json", R"({"quell": 1, "inputs": {"color": "radiance"},
    "nodes": {"clamp": {"type": "outlier_clamp", "in": {"image": "color"}},
              "energy": {"type": "energy_removed", "in": {"before": "color", "after": "clamp"}},
              "about": {"type": "statistics", "in": {"image": "color"}}},
    "outputs": {"removed": "energy.energy", "color": "clamp"}})");
  const std::vector<std::string> args{"run", "values.json", "shot.json", "--report", "report.json"};
  const auto r = quell(args + std::vector<std::string>{"--tap", "about.mean", "--tap", "about.invalid"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_NE(r.err.find("\nremoved: "), std::string::npos) << r.err;
  EXPECT_EQ(files("out"), (std::vector<std::string>{"color.0001.exr", "color.0002.exr", "color.0003.exr"}));
  const auto j = json::parse(read("report.json"))["values"];
  ASSERT_EQ(j.size(), 3u) << j;
  const auto& mean = j["about.mean"];
  EXPECT_EQ(mean["frames"].size(), 3u);
  EXPECT_EQ(mean["minimum"], mean["frames"]["1"]);
  EXPECT_EQ(mean["maximum"], mean["frames"]["3"]);
  EXPECT_NEAR(
      mean["mean"].get<double>(),
      (mean["frames"]["1"].get<double>() + mean["frames"]["2"].get<double>() + mean["frames"]["3"].get<double>()) / 3,
      1e-6);
  EXPECT_EQ(j["about.invalid"]["maximum"], 0);
  const auto refused = quell(args + std::vector<std::string>{"-o", "removed=x.####.exr"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.err.find("quell: error: -o removed=x.####.exr: output 'removed' is a number a frame, which no file "
                             "is written of: it is printed, and --report writes it\n"),
            std::string::npos)
      << refused.err;
}

}  // namespace
}  // namespace quell::test
