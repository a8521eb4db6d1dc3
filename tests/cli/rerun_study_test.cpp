// Images of studies, comparisons and suites say how they were made too, and are made again from that alone.
#include "tests/support/quell_command.h"

#include "core/sequence/image_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>

namespace quell::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class RerunStudy : public QuellCommand {
 protected:
  void expect_identical(const std::string& image, const std::string& frames) {
    const auto r = quell({"rerun", image});
    EXPECT_EQ(r.exit, 0) << r.out << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_EQ(r.out, fmt::format("{}: identical, bit for bit; made again from frames {}\n", image, frames));
  }
  std::string attribute(const std::string& file, const std::string& name) {
    return ImageFile(path(file)).texts()[name];
  }
  void ablate(std::vector<std::string> args) {
    const auto r = quell(std::vector<std::string>{"ablate", "./study.json", "--quiet"} + args);
    ASSERT_EQ(r.exit, 0) << r.err;
  }
  void write_room_study(int last, int spp) {
    write("study.json", fmt::format(R"({{
      "quell_study": 1, "name": "again", "graph": "svgf", "metrics": ["relmse", "flicker"], "warm_up": 2,
      "sequences": [{{ "path": "room", "frames": "0-{}", "source": {{ "width": 48, "height": 27 }},
                      "reference": {{ "width": 48, "height": 27, "spp": {} }} }}],
      "variants": {{ "stiff": {{ "set": {{ "alpha": 0.5 }} }} }}, "baselines": ["unfiltered"] }})",
                                    last, spp));
  }
  // Files of a renderer: colour of every frame, a reference of some.
  void write_shot() {
    write("shot.json", R"({"quell_sequence": 1, "frames": "1-6", "cuts": [3], "root": "shot",
      "inputs": {"color": {"file": "c.####.exr", "scale": 0.5}},
      "reference": {"A": {"file": "a.####.exr"}, "B": {"file": "b.####.exr"}}})");
    for (int f = 1; f <= 6; ++f) write_color(fmt::format("shot/c.{:04}.exr", f), 16, 8, float(f));
    for (const int f : {4, 6})
      for (const char half : {'a', 'b'})
        write_color(fmt::format("shot/{}.{:04}.exr", half, f), 16, 8, half == 'a' ? 3 : 2);
    write("past.json", R"({"quell": 1, "name": "past", "inputs": {"color": "radiance"}, "nodes": {
      "both": {"type": "sum", "in": {"images": ["color", {"from": "both@-1", "start": "color"}]}}}, "outputs": {"now": "both"}})");
  }
};

TEST_F(RerunStudy, MakesEveryKindOfImageAgain) {
  write_room_study(4, 4);
  ablate({"-o", "out", "--maps"});
  expect_identical("out/images/room/stiff.0004.exr", "0-4");
  expect_identical("out/images/room/unfiltered.0003.exr", "3");
  expect_identical("out/images/room/0003.input.exr", "3");
  expect_identical("out/images/room/0003.reference.exr", "3");
  expect_identical("out/images/room/maps/relmse/stiff.0004.exr", "0-4");
  expect_identical("out/images/room/maps/flicker/unfiltered.0004.exr", "0-4");
  const std::string image = "out/images/room/stiff.0004.exr";
  EXPECT_NE(attribute(image, "quell:command").find("ablate ./study.json"), std::string::npos);
  EXPECT_NE(attribute(image, "quell:run").find("run svgf room"), std::string::npos);
  EXPECT_EQ(attribute(image, "quell:variant"), "stiff");
  EXPECT_EQ(attribute(image, "quell:study"), "again");
  const auto results = json::parse(read("out/results.json"));
  EXPECT_EQ(results["variants"][1]["graph"].dump(), nlohmann::json::parse(attribute(image, "quell:graph")).dump());
}

TEST_F(RerunStudy, TellsWhichFilesHaveChanged) {
  write_shot();
  write("study.json", R"({"quell_study": 1, "name": "files", "graph": "past.json", "sequences": ["shot.json"],
                          "metrics": ["mse"], "warm_up": 0, "variants": {"own": {"graph": "unfiltered"}}})");
  ablate({"-o", "out", "--maps", "--images"});
  const std::string folder = "out/images/shot/";
  expect_identical(folder + "base.0006.exr", "3-6");
  expect_identical(folder + "base.0002.exr", "1-2");
  expect_identical(folder + "0006.reference.exr", "6");
  expect_identical(folder + "maps/mse/base.0006.exr", "3-6");
  // Nothing is judged, and so nothing shown, where a half is missing.
  EXPECT_FALSE(fs::exists(path(folder + "maps/mse/base.0005.exr")));
  EXPECT_FALSE(fs::exists(path(folder + "0005.reference.exr")));

  write_color("shot/b.0006.exr", 16, 8, 7);
  expect_identical(folder + "base.0006.exr", "3-6");
  auto r = quell({"rerun", folder + "maps/mse/base.0006.exr"});
  EXPECT_EQ(r.exit, 1);
  EXPECT_NE(r.out.find("\n  frame 6: reference_b: b.0006.exr has changed\n"), std::string::npos) << r.out;
  r = quell({"rerun", folder + "maps/mse/base.0006.exr", "--root", "."});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("was made from several sequences"), std::string::npos) << r.err;
}

TEST_F(RerunStudy, KnowsTheHistoryOfWhatWasInterrupted) {
  write_room_study(23, 24);
  Program program(command({"ablate", "./study.json", "-o", "out", "--threads", "1"}), here());
  ASSERT_TRUE(program.wait_until([&] { return fs::exists(path("out/journal/room/own/.part.json")); }));
  program.send(SIGKILL);
  ASSERT_EQ(program.finish().signal, SIGKILL);
  ablate({"-o", "out", "--resume"});
  expect_identical("out/images/room/stiff.0023.exr", "0-23");
}

TEST_F(RerunStudy, MakesMapsOfComparisonsAgain) {
  write_shot();
  for (const auto* name : {"one", "two"})
    for (int f = 4; f <= 6; ++f)
      write_color(fmt::format("{}/now.{:04}.exr", name, f), 16, 8, name[0] == 'o' ? 1 : 2.25f);
  const auto r =
      quell({"compare", "one=one/now.####.exr", "two=two/now.####.exr", "--reference", "shot.json", "--metric",
             "mse_unbiased,mse", "--frames", "4-6", "--maps", "maps", "--json", "numbers.json", "--quiet"});
  ASSERT_EQ(r.exit, 0) << r.err;
  expect_identical("maps/one.mse.0004.exr", "4");
  expect_identical("maps/two.mse_unbiased.0006.exr", "6");
  const auto preview = quell({"rerun", "maps/two.mse.0006.png"});
  EXPECT_EQ(preview.exit, 2);
  EXPECT_NE(preview.err.find("is a preview of 'map'"), std::string::npos) << preview.err;
  EXPECT_TRUE(json::parse(read("numbers.json"))["variants"][1]["graph"]["nodes"].is_object());
  // The same picture serves all frames.
  write_color("still.exr", 16, 8, 2);
  ASSERT_EQ(quell({"compare", "still=still.exr", "--reference", "shot.json", "--metric", "mse", "--frames", "4-6",
                   "--maps", "maps", "--quiet"})
                .exit,
            0);
  expect_identical("maps/still.mse.0006.exr", "6");
}

TEST_F(RerunStudy, MakesFailedPicturesOfSuitesAgain) {
  write_shot();
  write("suite.json", R"({"quell_suite": 1, "name": "held", "golden": "golden", "tests": {
      "now": {"graph": "past.json", "sequence": {"path": "shot.json"}, "golden": {"frames": "5"}}}})");
  ASSERT_EQ(quell({"test", "suite.json", "--update-golden"}).exit, 0);
  // What is kept with a project says nothing of one machine.
  const auto golden = ImageFile(path("golden/now.0005.exr")).texts();
  EXPECT_TRUE(golden.contains("quell:graph") && golden.contains("quell:plugins"));
  for (const auto& [name, text] : golden) EXPECT_EQ(text.find(path("")), std::string::npos) << name << ": " << text;
  write_color("shot/c.0005.exr", 16, 8, 1);
  ASSERT_EQ(quell({"test", "suite.json", "--failures", "failed"}).exit, 1);
  expect_identical("failed/now.found.0005.exr", "3-5");
}

}  // namespace
}  // namespace quell::test
