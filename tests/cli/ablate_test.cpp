// quell ablate: what a study writes, and that no way of ending it changes that.
#include "tests/support/quell_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <regex>
#include <sstream>

namespace quell::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kStudy = R"({
  "quell_study": 1, "name": "parts_of it", "about": "For a test.", "graph": "svgf",
  "sequences": [{ "path": "room", "frames": "0-FRAMES", "source": { "width": 48, "height": 27 },
                  "reference": { "width": 48, "height": 27, "spp": SPP } }],
  "variants": { "stiff": { "set": { "alpha": ALPHA } } },
  "leave_one_out": ["by_normal"],
  "each_feedback_level": { "wire": "history.image", "levels": ["blend", "level0.image"] },
  "metrics": ["psnr_unbiased", "mse", "flicker"], "warm_up": 2, "baselines": ["unfiltered"] MORE
})";

std::string study(int last_frame, const std::string& alpha = "0.5", int spp = 4, const std::string& more = "") {
  std::string text = kStudy;
  const auto replace = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  replace("FRAMES", std::to_string(last_frame)), replace("SPP", std::to_string(spp));
  replace("ALPHA", alpha), replace("MORE", more);
  return text;
}

class Ablate : public QuellCommand {
 protected:
  // Runs the study into a folder, which must work.
  ProgramResult ablate(const std::string& folder, std::vector<std::string> args = {}) {
    auto r = quell(std::vector<std::string>{"ablate", "./study.json", "-o", folder} + args);
    EXPECT_EQ(r.exit, 0) << r.err;
    return r;
  }
  json results(const std::string& folder) const { return json::parse(read(folder + "/results.json")); }
};

// "**28.29** ± 0.81" and "\textbf{28.29} $\pm$ 0.81": the numbers.
std::vector<double> numbers_of(const std::string& cell) {
  static const std::regex number(R"(-?\d+(\.\d+)?)");
  std::vector<double> all;
  for (std::sregex_iterator it(cell.begin(), cell.end(), number), end; it != end; ++it)
    all.push_back(std::stod(it->str()));
  return all;
}

std::vector<std::string> split(const std::string& line, char at) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

std::vector<std::string> lines_with(const std::string& text, const std::string& what) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (line.find(what) != line.npos) lines.push_back(line);
  return lines;
}

TEST_F(Ablate, WritesNumbersThatAgreeWhereverTheyStand) {
  write("study.json", study(5, "0.5", 4, R"(, "sweeps": { "alpha": [0.3], "alpha_moments": [0.4] })"));
  ablate("out");
  const auto r = results("out");
  ASSERT_EQ(r["variants"].size(), 7u);
  EXPECT_EQ(r["variants"][5]["name"], "alpha=0.3,alpha_moments=0.4");
  ASSERT_EQ(r["rows"].size(), 7u * 6u * 3u);

  // results.csv: the same rows in the same order.
  auto csv = split(read("out/results.csv"), '\n');
  ASSERT_EQ(csv.size(), r["rows"].size() + 1);
  for (std::size_t i = 0; i < r["rows"].size(); ++i) {
    const auto& row = r["rows"][i];
    const std::string name = row["variant"].get<std::string>();
    const auto quoted = name.find(',') == name.npos ? name : "\"" + name + "\"";
    const auto value = row["value"].is_null() ? "" : row["value"].dump();
    EXPECT_EQ(csv[i + 1], fmt::format("{},room,,{},{},{}", quoted, row["frame"].get<int>(),
                                      row["metric"].get<std::string>(), value));
  }

  // The summary: means of the rows behind the warm-up.
  for (const auto& s : r["summary"]) {
    double sum = 0;
    int count = 0;
    for (const auto& row : r["rows"])
      if (row["variant"] == s["variant"] && row["metric"] == s["metric"] && row["frame"] >= 2 &&
          !row["value"].is_null())
        sum += row["value"].get<double>(), ++count;
    ASSERT_EQ(s["frames"], count);
    EXPECT_EQ(count, 4);
    EXPECT_NEAR(s["mean"].get<double>(), sum / count, 1e-12 * std::abs(sum));
    EXPECT_LE(s["low"].get<double>(), s["mean"].get<double>());
  }

  // Both tables: those means and half intervals, to as many digits as they show, and the costs of timings.json.
  const auto timings = json::parse(read("out/timings.json"));
  const auto markdown = lines_with(read("out/table.md"), "| "), latex = lines_with(read("out/table.tex"), " & ");
  ASSERT_EQ(markdown.size(), 8u);
  ASSERT_EQ(latex.size(), 8u);
  int best = 0;
  for (std::size_t v = 0; v < 7; ++v) {
    const auto md = split(markdown[v + 1], '|'), tex = split(latex[v + 1].substr(0, latex[v + 1].find("\\\\")), '&');
    ASSERT_EQ(tex.size(), 5u);
    for (std::size_t m = 0; m < 3; ++m) {
      const auto& s = r["summary"][v * 3 + m];
      ASSERT_EQ(s["variant"], r["variants"][v]["name"]);
      const auto a = numbers_of(md[m + 2]), b = numbers_of(tex[m + 1]);
      EXPECT_EQ(a, b);
      ASSERT_EQ(a.size(), 2u) << markdown[v + 1];
      const auto text = md[m + 2].substr(md[m + 2].find('.') + 1);
      const double step = std::pow(10, -double(std::min(text.find_first_not_of("0123456789"), text.size())));
      EXPECT_NEAR(a[0], s["mean"].get<double>(), 0.5001 * step);
      EXPECT_NEAR(a[1], (s["high"].get<double>() - s["low"].get<double>()) / 2, 0.5001 * step);
      best += md[m + 2].find("**") != std::string::npos;
      EXPECT_EQ(md[m + 2].find("**") != std::string::npos, tex[m + 1].find("textbf") != std::string::npos);
    }
    EXPECT_EQ(timings["variants"][v]["name"], r["variants"][v]["name"]);
    EXPECT_NEAR(numbers_of(md[5]).at(0), timings["variants"][v]["cost_ms"].get<double>(), 0.0501);
  }
  EXPECT_GE(best, 3);  // one a metric, more where they tie
}

TEST_F(Ablate, GivesTheBitsOfSeparateRuns) {
  write("study.json", study(4));
  ablate("out", {"--images"});
  const auto r = results("out");
  for (const auto& v : r["variants"]) {
    const auto name = v["name"].get<std::string>(), command = v["command"].get<std::string>();
    auto args = split(command, ' ');
    args.erase(args.begin());
    const auto ran = quell(args + std::vector<std::string>{"-o", fmt::format("alone/{}.####.exr", name)});
    ASSERT_EQ(ran.exit, 0) << command << "\n" << ran.err;
    const auto written = quell({"check", fmt::format("out/variants/{}.json", name)});
    EXPECT_EQ(written.exit, 0) << written.err;
    for (int f = 0; f < 5; ++f)
      EXPECT_EQ(pixels(fmt::format("out/images/room/{}.000{}.exr", name, f)),
                pixels(fmt::format("alone/{}.000{}.exr", name, f)))
          << name << ", frame " << f;
  }
  // The level that the graph feeds back anyway is the graph itself, and computed once with it.
  EXPECT_EQ(r["variants"][4]["fingerprint"], r["variants"][0]["fingerprint"]);
  EXPECT_NE(r["variants"][3]["fingerprint"], r["variants"][0]["fingerprint"]);
  const auto saving = json::parse(read("out/timings.json"))["saving"];
  EXPECT_LT(saving["nodes"].get<int>() * 10, saving["nodes_of_separate_runs"].get<int>() * 7);
  EXPECT_LT(saving["seconds"].get<double>(), saving["seconds_of_separate_runs"].get<double>());
}

TEST_F(Ablate, GoesOnAfterKillAsIfNothingHadBeen) {
  write("study.json", study(23, "0.5", 24));
  ablate("whole");
  for (const bool groups : {false, true}) {
    const std::string folder = groups ? "killed_groups" : "killed";
    const auto command_line = command({"ablate", "./study.json", "-o", folder, "--threads", "1"});
    Program program(command_line, here());
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(path(folder + "/journal/room/own/.part.json")); }));
    program.send(SIGKILL);
    const auto killed = program.finish();
    ASSERT_EQ(killed.signal, SIGKILL);
    ASSERT_FALSE(fs::exists(path(folder + "/results.json")));
    const auto r = ablate(folder, {"--resume"});
    EXPECT_NE(r.err.find("going on with frame "), std::string::npos) << r.err;
    EXPECT_EQ(read(folder + "/results.json"), read("whole/results.json"));
    EXPECT_EQ(read(folder + "/results.csv"), read("whole/results.csv"));
    for (const auto& file : files("whole/images/room"))
      EXPECT_EQ(pixels(folder + "/images/room/" + file), pixels("whole/images/room/" + file)) << file;
    if (!groups) continue;
    // Nothing is left of the part but what is finished.
    for (const auto& file : files(folder + "/journal/room/own")) EXPECT_NE(file[0], '.') << file;
  }
}

TEST_F(Ablate, EndsAtInterruptsAndSaysHowToGoOn) {
  write("study.json", study(23, "0.5", 24));
  Program program(command({"ablate", "./study.json", "-o", "out"}), here());
  ASSERT_TRUE(program.wait_until([&] { return fs::exists(path("out/journal/room/own/.part.json")); }));
  program.send(SIGINT);
  const auto r = program.finish();
  EXPECT_EQ(r.exit, 130);
  EXPECT_EQ(r.err, "quell: interrupted; quell ablate ./study.json -o out --resume goes on\n");
  const auto again = ablate("out", {"--resume"});
  EXPECT_NE(again.err.find("going on with frame "), std::string::npos);
}

TEST_F(Ablate, LosesNoFrameToAnInterrupt) {
  write("study.json", study(23, "0.5", 24));
  Program program(command({"ablate", "./study.json", "-o", "out", "--progress", "json"}), here());
  // Past the first part that is kept, and before all is done.
  ASSERT_TRUE(program.wait_until([&] { return fs::exists(path("out/images/room/base.0002.exr")); }));
  program.send(SIGINT);
  const auto r = program.finish();
  ASSERT_EQ(r.exit, 130) << r.err;
  const auto told = lines_with(r.err, "{");
  ASSERT_FALSE(told.empty());
  const int last = json::parse(told.back())["frame"];
  ASSERT_LT(last, 23);
  const auto again = ablate("out", {"--resume"});
  EXPECT_NE(again.err.find(fmt::format("going on with frame {}", last + 1)), std::string::npos) << last << again.err;
  ablate("whole");
  EXPECT_EQ(read("out/results.json"), read("whole/results.json"));
}

TEST_F(Ablate, ComputesAgainWhatHasChangedAndNothingElse) {
  write("study.json", study(5));
  ablate("out");
  const auto before = results("out");
  const auto refused = quell({"ablate", "./study.json", "-o", "out"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_EQ(refused.err,
            "quell: error: out holds the work of an earlier run\n  --resume goes on with it: what has not changed is "
            "not computed again; --restart begins anew\n");

  const auto time_of = [&](const std::string& variant) {
    return fs::last_write_time(path("out/journal/room/own/" + variant + ".json"));
  };
  const auto base = time_of("base"), stiff = time_of("stiff");
  write("study.json", study(5, "0.75"));
  ablate("out", {"--resume"});
  EXPECT_EQ(time_of("base"), base);
  EXPECT_NE(time_of("stiff"), stiff);
  const auto after = results("out");
  write("study.json", study(5, "0.75"));
  ablate("fresh");
  EXPECT_EQ(read("out/results.json"), read("fresh/results.json"));
  EXPECT_NE(before["rows"], after["rows"]);
  // An image that is gone is made again.
  fs::remove(path("out/images/room/base.0005.exr"));
  ablate("out", {"--resume"});
  EXPECT_EQ(pixels("out/images/room/base.0005.exr"), pixels("fresh/images/room/base.0005.exr"));
  ablate("out", {"--restart"});
  EXPECT_EQ(read("out/results.json"), read("fresh/results.json"));
}

TEST_F(Ablate, TakesGroupsWhereMemoryIsShort) {
  write("study.json", study(3));
  ablate("whole");
  const auto r = ablate("groups", {"--max-memory", "0.0006"});
  EXPECT_TRUE(std::regex_search(r.err, std::regex("room: 6 variants in [2-6] groups, for --max-memory has no room")))
      << r.err;
  EXPECT_EQ(read("groups/results.json"), read("whole/results.json"));
  const auto none = quell({"ablate", "./study.json", "-o", "none", "--max-memory", "0.0001"});
  EXPECT_EQ(none.exit, 5);
  EXPECT_NE(none.err.find("raise --max-memory"), std::string::npos) << none.err;
}

TEST_F(Ablate, RunsEverySequenceWithEverySeed) {
  const std::string more = R"(, "seeds": { "parameter": "seed", "values": [3, 7] })";
  auto text = study(3, "0.5", 4, more);
  const std::string end = R"("spp": 4 } }])";
  text.replace(text.find(end), end.size(), R"("spp": 4 } }, { "path": "arcade", "name": "with a cut"})");
  write("bad.json", text);
  EXPECT_EQ(quell({"ablate", "./bad.json", "--check"}).exit, 2);
  text.replace(text.find(R"({ "path": "arcade", "name": "with a cut"})"), 41,
               R"({ "path": "arcade", "name": "cut", "frames": "14-18", "source": { "width": 32, "height": 18 },
                    "reference": { "width": 32, "height": 18, "spp": 2 } }])");
  write("study.json", text);
  ablate("out", {"--maps"});
  const auto r = results("out");
  EXPECT_EQ(r["sequences"][1]["size"], (json{32, 18}));
  EXPECT_EQ(r["sequences"][0]["seeds"], (json{3, 7}));
  std::map<std::string, double> of_seed;
  for (const auto& row : r["rows"])
    if (row["variant"] == "base" && row["metric"] == "mse" && row["sequence"] == "cut" && row["frame"] == 18)
      of_seed[row["seed"].dump()] = row["value"].get<double>();
  ASSERT_EQ(of_seed.size(), 2u);
  EXPECT_NE(of_seed["3"], of_seed["7"]);
  // By sequence, and over all: 2 seeds of 2 and 3 frames.
  for (const auto& s : r["summary"])
    if (s["metric"] == "mse") {
      EXPECT_EQ(s["frames"], s["sequence"] == "room" ? 4 : s["sequence"] == "cut" ? 6 : 10);
    }
  // Flicker has no number where history begins: frame 14, and the cut before 16.
  for (const auto& row : r["rows"])
    if (row["metric"] == "flicker" && row["sequence"] == "cut") {
      EXPECT_EQ(row["value"].is_null(), row["frame"] == 14 || row["frame"] == 16) << row;
    }
  for (const auto& image : r["images"])
    EXPECT_TRUE(fs::exists(path("out/" + image["file"].get<std::string>()))) << image;
}

TEST_F(Ablate, FindsNothingWrongWithTheStudiesThatShip) {
  for (const char* name : {"svgf", "svgf_parameters", "games202", "lag"}) {
    const auto r = quell({"ablate", name, "--check"});
    EXPECT_EQ(r.exit, 0) << r.err;
    EXPECT_EQ(r.err, "");
  }
  const auto r = quell({"ablate", "svfg", "--check"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(
      r.err.find(
          "there is no study 'svfg'\n  installed are: games202, lag, svgf, svgf_parameters. Did you mean 'svgf'?"),
      std::string::npos)
      << r.err;
}

// A reference of some frames judges those frames; what looks back needs it there as well.
TEST_F(Ablate, LeavesOutFramesWithoutAReference) {
  for (int f = 1; f <= 5; ++f) write_color(fmt::format("shot/color_{}.exr", f), 9, 5, 0.5f);
  for (const int f : {2, 4, 5}) write_color(fmt::format("shot/truth_{}.exr", f), 9, 5, 0.25f);
  write("shot.json", R"({ "quell_sequence": 1, "frames": "1-5", "root": "shot",
    "inputs": { "color": { "file": "color_@.exr" } }, "reference": { "file": "truth_@.exr" } })");
  write("late.json", R"({ "quell": 1, "metric": { "better": "lower" },
    "inputs": { "image": "radiance", "reference": "radiance" },
    "nodes": { "error": { "type": "difference", "in": { "image": "image", "reference": "reference@-1" } },
               "mean": { "type": "mean", "in": { "map": "error" } } },
    "outputs": { "value": "mean.value" } })");
  write("study.json", R"({ "quell_study": 1, "graph": "unfiltered", "sequences": ["shot.json"],
    "metrics": ["mse", "./late.json"], "warm_up": 0 })");
  ablate("out");
  const auto r = results("out");
  for (const auto& row : r["rows"]) {
    const int frame = row["frame"];
    const bool there = frame == 2 || frame == 4 || frame == 5;
    if (row["metric"] == "mse") {
      EXPECT_EQ(row["value"].is_null(), !there) << row;
      if (there) {
        EXPECT_EQ(row["value"], 0.0625);
      }
    } else {
      EXPECT_EQ(row["value"].is_null(), frame != 5) << row;
    }
  }
}

TEST_F(Ablate, AReferenceThatIsNotFiniteEndsTheStudy) {
  for (int f = 1; f <= 3; ++f) write_color(fmt::format("color_{}.exr", f), 9, 5, 0.5f);
  for (int f = 1; f <= 3; ++f) write_color(fmt::format("truth_{}.exr", f), 9, 5, f == 3 ? NAN : 0.25f);
  write("shot.json", R"({ "quell_sequence": 1, "frames": "1-3",
    "inputs": { "color": { "file": "color_@.exr" } }, "reference": { "file": "truth_@.exr" } })");
  write("study.json", R"({ "quell_study": 1, "graph": "unfiltered", "sequences": ["shot.json"], "metrics": ["mse"],
                           "warm_up": 0 })");
  const auto r = quell({"ablate", "study.json", "-o", "out", "--quiet"});
  EXPECT_EQ(r.exit, 3);
  EXPECT_NE(r.err.find("the reference of 'shot': frame 3: "), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("is not finite: pixel (0, 0) holds nan in channel"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace quell::test
