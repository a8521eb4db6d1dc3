// quell compare: numbers, tables, thresholds and what is said of what does not fit.
#include "core/report/shell.h"
#include "tests/support/quell_command.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace quell::test {
namespace {

using nlohmann::json;

class Compare : public QuellCommand {
 protected:
  void SetUp() override {
    for (int f = 1; f <= 3; ++f) {
      write_color(fmt::format("truth.{:04}.exr", f), 24, 16, 0.5f);
      write_color(fmt::format("near.{:04}.exr", f), 24, 16, 0.5f + 0.125f * float(f));
      write_color(fmt::format("far.{:04}.exr", f), 24, 16, 1.5f);
    }
  }
  ProgramResult compare(std::vector<std::string> args) { return quell(std::vector<std::string>{"compare"} + args); }
  json numbers(const std::string& name) const { return json::parse(read(name)); }
};

// The mean of all frames of one metric.
double mean(const json& results, const std::string& variant, const std::string& metric) {
  for (const auto& s : results["summary"])
    if (s["variant"] == variant && s["metric"] == metric) return s["mean"];
  ADD_FAILURE() << "no summary of " << variant << ", " << metric;
  return NAN;
}

TEST_F(Compare, NumbersAreThoseOfTheFormula) {
  const auto r = compare({"near.####.exr", "far=far.####.exr", "--reference", "truth.####.exr", "--metric", "mse,rmse",
                          "--metric", "relmse", "--json", "n.json", "--csv", "n.csv"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = numbers("n.json");
  const double squares = 0.125 * 0.125 * (1 + 4 + 9) / 3;
  EXPECT_NEAR(mean(j, "near.####.exr", "mse"), squares, 1e-7);
  EXPECT_NEAR(mean(j, "near.####.exr", "rmse"), 0.25, 1e-7);
  EXPECT_NEAR(mean(j, "far", "mse"), 1, 1e-6);
  EXPECT_NEAR(mean(j, "far", "relmse"), 1 / (0.25 + 0.01), 1e-5);
  EXPECT_EQ(j["rows"].size(), 2u * 3 * 3);
  EXPECT_EQ(j["sequences"][0]["frames"], (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(std::ranges::count(read("n.csv"), '\n'), 1 + 2 * 3 * 3);
  // The better of the two is marked.
  EXPECT_NE(r.out.find("mse ↓"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("*"), std::string::npos) << r.out;
}

TEST_F(Compare, SinglePicturesOfAnotherTool) {
  write_color("a.exr", 200, 170, 0.5f);
  ASSERT_EQ(quell({"run", "unfiltered", "truth.####.exr", "--frames", "1", "-o", "x.exr"}).exit, 2)
      << "no profile knows plain pictures, so that compare must not need one";
  const auto r = compare({"a.exr", "--reference", "a.exr", "--json", "n.json", "--quiet"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(r.out, "");
  const auto j = numbers("n.json");
  EXPECT_EQ(mean(j, "a.exr", "flip"), 0);
  EXPECT_EQ(mean(j, "a.exr", "ssim"), 1);
  EXPECT_EQ(mean(j, "a.exr", "relmse"), 0);
}

// Whole numbers without a colour space are sRGB, and gray is a colour.
TEST_F(Compare, PicturesOfOtherToolsAreTakenAsTheyAreShown) {
  write("gray.pgm", "P5\n24 16\n255\n" + std::string(24 * 16, '\xBC'));
  write("rgb.ppm", "P6\n24 16\n255\n" + std::string(3 * 24 * 16, '\xBC'));
  write_color("light.exr", 24, 16, float(std::pow((188.0 / 255 + 0.055) / 1.055, 2.4)));
  const auto r = compare({"gray.pgm", "rgb.ppm", "--reference", "light.exr", "--metric", "rmse", "--json", "n.json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = numbers("n.json");
  EXPECT_EQ(mean(j, "gray.pgm", "rmse"), mean(j, "rgb.ppm", "rmse"));
  EXPECT_LT(mean(j, "rgb.ppm", "rmse"), 1.0 / 4096);  // half has 11 bits
}

TEST_F(Compare, ThresholdsDecideTheExitCode) {
  const std::vector<std::string> args = {"near.####.exr", "--reference", "truth.####.exr", "--metric", "mse"};
  EXPECT_EQ(compare(args + std::vector<std::string>{"--fail", "mse > 0.1"}).exit, 0);
  const auto r = compare(args + std::vector<std::string>{"--fail", "mse.max > 0.1", "--fail", "rmse < 0.2"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_EQ(r.err, "failed: near.####.exr: mse.max > 0.1: the max is 0.140625\n");
  // What a threshold names is computed though nobody asked for it.
  EXPECT_EQ(compare(args + std::vector<std::string>{"--fail", "rmse >= 0.25"}).exit, 1);
}

TEST_F(Compare, OptionsMayStandBeforePictures) {
  const auto r = compare({"--reference", "truth.####.exr", "--fail", "mse > 9", "--metric", "mse", "near.####.exr",
                          "far.####.exr", "--json", "n.json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_NEAR(mean(numbers("n.json"), "far.####.exr", "mse"), 1, 1e-6);
}

TEST_F(Compare, JsonOnTheStandardOutputIsAlone) {
  const auto r =
      compare({"near.####.exr", "--reference", "truth.####.exr", "--metric", "mse", "--json", "-", "--frames", "2"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_NEAR(mean(json::parse(r.out), "near.####.exr", "mse"), 0.0625, 1e-7);
}

TEST_F(Compare, OneReferenceMayServeAllFrames) {
  const auto r = compare({"near.####.exr", "--reference", "truth.0001.exr", "--metric", "rmse", "--json", "n.json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_NEAR(mean(numbers("n.json"), "near.####.exr", "rmse"), 0.25, 1e-7);
}

TEST_F(Compare, MapsAreWrittenForProgramsAndForTheEye) {
  const auto r = compare(
      {"n=near.####.exr", "--reference", "truth.####.exr", "--metric", "mse", "--maps", "maps", "--frames", "1-2"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(files("maps"),
            (std::vector<std::string>{"n.mse.0001.exr", "n.mse.0001.png", "n.mse.0002.exr", "n.mse.0002.png"}));
  const auto map = pixels("maps/n.mse.0002.exr");
  EXPECT_EQ(map.width, 24);
  EXPECT_NEAR(map.channels.begin()->second[5], 0.0625f, 1e-5f);
}

TEST_F(Compare, MapsAreCalledByTheirPictures) {
  const std::vector<std::string> args = {"--reference", "truth.0001.exr", "--metric", "mse", "--maps", "maps", "-q"};
  for (const auto& name : {"a/c.0002.exr", "a/c.0003.exr", "a_c.exr"}) write_color(name, 24, 16, 0.25f);
  auto r = compare(std::vector<std::string>{"./a/c.####.exr", "x=a/c.####.exr", "a/c.0003.exr"} + args);
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(files("maps"),
            (std::vector<std::string>{"a_c.0003.mse.0002.exr", "a_c.0003.mse.0002.png", "a_c.0003.mse.0003.exr",
                                      "a_c.0003.mse.0003.png", "a_c.mse.0002.exr", "a_c.mse.0002.png",
                                      "a_c.mse.0003.exr", "a_c.mse.0003.png", "x.mse.0002.exr", "x.mse.0002.png",
                                      "x.mse.0003.exr", "x.mse.0003.png"}));
  r = compare(std::vector<std::string>{"a/c.%04d.exr", "a_c.exr"} + args);
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("the maps of 'a/c.%04d.exr' and of 'a_c.exr' would both be called 'a_c'; NAME=… names"),
            std::string::npos)
      << r.err;
}

TEST_F(Compare, OneFileForAllFramesIsWarnedOf) {
  auto r = compare({"near.0002.exr", "--reference", "truth.####.exr", "--metric", "mse"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(r.err, "warning: 'near.0002.exr' is one file and stands for all 3 frames; --frames picks one\n");
  r = compare({"near.0002.exr", "--reference", "truth.####.exr", "--metric", "mse", "--frames", "2"});
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err, "");
}

TEST_F(Compare, NothingThatIsReadIsWrittenOver) {
  const std::vector<std::string> args = {"near.####.exr", "--reference", "truth.####.exr", "--metric", "mse"};
  const auto refused = [&](const std::vector<std::string>& more, const std::string& says) {
    const auto r = compare(args + more);
    EXPECT_EQ(r.exit, 2) << r.err;
    EXPECT_NE(r.err.find(says), std::string::npos) << r.err;
  };
  const auto before = read("near.0002.exr");
  refused({"--csv", "./near.0002.exr"}, "./near.0002.exr is read");
  refused({"--json", "truth.0003.exr"}, "truth.0003.exr is read");
  refused({"--json", "-", "--csv", "-"}, "--json and --csv would both go to the standard output");
  refused({"--json", "n", "--csv", "./n"}, "--json and --csv would both go to n");
  write_color("maps/n.mse.0001.exr", 24, 16, 1);
  refused({"n=maps/n.mse.####.exr", "--maps", "maps", "--frames", "1"}, "maps/n.mse.0001.exr is read");
  for (const auto* option : {"--json", "--csv", "--maps", "--references", "--reference", "--frames"})
    refused({option, ""}, std::string(option) + ": is empty");
  EXPECT_EQ(read("near.0002.exr"), before);
}

TEST_F(Compare, AnyNameIsOneFieldOfTheCsv) {
  write_color("q,\"b.exr", 24, 16, 0.5f);
  const auto r = compare({"q,\"b.exr", "--reference", "truth.0001.exr", "--metric", "mse", "--csv", "-"});
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_NE(r.out.find("\n\"q,\"\"b.exr\",pictures,,0,mse,0"), std::string::npos) << r.out;
}

TEST_F(Compare, TheTableBeginsBehindTheProgress) {
  const auto r = run_program({"/usr/bin/script", "-qec",
                              shell_text(command({"compare", path("near.####.exr"), "--reference",
                                                  path("truth.####.exr"), "--metric", "mse"})),
                              path("typescript")});
  ASSERT_EQ(r.exit, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("(3/3)"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("left\033[K\r\n"), std::string::npos) << r.out;
  EXPECT_FALSE(r.out.ends_with("\n\r\n")) << r.out;
}

TEST_F(Compare, ASequenceServesReferenceAndMotion) {
  ASSERT_EQ(quell({"run", "unfiltered", "room", "--source", "width=64", "--source", "height=36", "--frames", "0-1",
                   "-o", "out/color.####.exr", "--quiet"})
                .exit,
            0);
  write("small.json", R"({"quell_sequence": 1, "frames": "0-1",
    "source": {"type": "path_tracer", "set": {"scene": "quell:scenes/room.json", "width": 64, "height": 36}},
    "reference": {
      "A": {"source": {"type": "path_tracer", "set": {"scene": "quell:scenes/room.json", "width": 64, "height": 36, "spp": 16, "seed": 5}}},
      "B": {"source": {"type": "path_tracer", "set": {"scene": "quell:scenes/room.json", "width": 64, "height": 36, "spp": 16, "seed": 6}}}}})");
  const auto r = compare({"noisy=out/color.####.exr", "--reference", "small.json", "--json", "n.json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = numbers("n.json");
  EXPECT_GT(mean(j, "noisy", "psnr_unbiased"), 10);
  EXPECT_LT(mean(j, "noisy", "psnr_unbiased"), 30);
  EXPECT_GT(mean(j, "noisy", "flicker"), 10);
  // The first frame has nothing before it.
  int empty = 0;
  for (const auto& row : j["rows"])
    if (row["metric"] == "flicker" && row["value"].is_null()) {
      EXPECT_EQ(row["frame"], 0);
      ++empty;
    }
  EXPECT_EQ(empty, 1);
}

TEST_F(Compare, ReferencesThatANodeMakesAreKept) {
  write("small.json", R"({"quell_sequence": 1, "frames": "0-1",
    "source": {"type": "path_tracer", "set": {"scene": "quell:scenes/room.json", "width": 24, "height": 16}},
    "reference": {"source": {"type": "path_tracer",
                             "set": {"scene": "quell:scenes/room.json", "width": 24, "height": 16, "spp": 2}}}})");
  const auto judged = [&](const std::vector<std::string>& more) {
    const std::vector<std::string> args = {"small.json", "--reference", "small.json", "--metric", "mse", "--json", "-"};
    const auto r = compare(args + more);
    EXPECT_EQ(r.exit, 0) << r.err;
    return json::parse(r.out)["rows"];
  };
  const auto anew = judged({});
  EXPECT_EQ(judged({"--references", "kept"}), anew);
  const auto kept = files("kept");
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_TRUE(kept[0].ends_with("/frame.0000.exr")) << kept[0];
  EXPECT_EQ(judged({"--references", "kept"}), anew);
  write_color("kept/" + kept[1], 24, 16, 7);
  EXPECT_EQ(judged({"--references", "kept", "--frames", "0"})[0], anew[0]);
  EXPECT_NE(judged({"--references", "kept"})[1], anew[1]) << "what is kept is read";
  // A sequence without a reference of its own is one by its colour, which is kept too.
  write("plain.json", R"({"quell_sequence": 1, "frames": "0-1",
    "source": {"type": "path_tracer", "set": {"scene": "quell:scenes/room.json", "width": 24, "height": 16}}})");
  ASSERT_EQ(compare({"near.0001.exr", "--reference", "plain.json", "--frames", "0", "--metric", "mse", "--references",
                     "colours", "--quiet"})
                .exit,
            0);
  EXPECT_EQ(files("colours").size(), 1u);
}

TEST_F(Compare, SaysWhatDoesNotFit) {
  const auto expect = [&](std::vector<std::string> args, int exit, const std::string& text) {
    const auto r = compare(args);
    EXPECT_EQ(r.exit, exit) << r.err;
    EXPECT_NE(r.err.find(text), std::string::npos) << r.err;
  };
  expect({"near.####.exr", "--reference", "none.exr"}, 3, "'none.exr': there is no such file");
  expect({"near.####.exr"}, 2, "there is nothing to judge by");
  expect({"near.####.exr", "near.####.exr", "--reference", "truth.####.exr"}, 2,
         "two of the pictures are called 'near.####.exr'; NAME=… names them apart");
  expect({"near.####.exr", "--reference", "truth.####.exr", "--metric", "mze"}, 2, "mze");
  expect({"near.####.exr", "--reference", "truth.####.exr", "--metric", "flicker"}, 2,
         "the metric 'flicker' reads 'motion', which is not there");
  expect({"near.####.exr", "--reference", "truth.####.exr", "--fail", "mse = 3"}, 2, "--fail 'mse = 3': expected");
  expect({"near.####.exr", "--reference", "truth.####.exr", "--metric", "mse,rmse", "--metric", "mse"}, 2,
         "--metric: two metrics are called 'mse'");
  expect({"near.####.exr", "--reference", "truth.####.exr", "--metric", "relmse_edges"}, 2,
         "'relmse_edges' reads id, normal, depth where that is there; --sequence names what has it");
  write("mine.json", R"({"quell": 1, "inputs": {"image": "radiance", "depth": "depth"},
    "nodes": {"slope": {"type": "depth_slope", "in": {"depth": "depth"}}}, "outputs": {"value": "slope"}})");
  expect({"near.####.exr", "--reference", "truth.####.exr", "--metric", "mine.json"}, 2, "is no metric: it lacks");
  expect({"ü=near.0001.exr", "--reference", "truth.####.exr"}, 3,
         "nor is 'ü' a NAME for pictures: names have letters, digits and _-+.");
  write_color("truth.0004.exr", 24, 16, 0.5f);
  expect({"truth.####.exr", "--reference", "near.####.exr", "--metric", "mse"}, 3,
         "the reference has no frame 4, which truth.####.exr has; --frames picks those that both have");
  write_color("small.exr", 12, 16, 0.5f);
  expect({"near.####.exr", "--reference", "small.exr", "--metric", "mse"}, 3,
         "frame 1: the reference is 12x16, but near.####.exr is 24x16");
  write_color("nan.exr", 24, 16, NAN);
  expect({"near.####.exr", "--reference", "nan.exr", "--metric", "mse"}, 3, "is not finite: pixel (0, 0) holds nan");
  expect({"nan.exr", "--reference", "near.0001.exr", "--metric", "mse"}, 3, "is not finite: pixel (0, 0) holds nan");
  expect({"x=", "--reference", "small.exr"}, 2, "NAME= is followed by the pictures");
}

}  // namespace
}  // namespace quell::test
