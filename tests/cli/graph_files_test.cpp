// quell check and quell plan: graph files that are right, wrong, huge or no files at all.
#include "tests/support/paths.h"
#include "tests/support/quell_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace quell::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class GraphFiles : public QuellCommand {
 protected:
  void expect_error(const std::vector<std::string>& args, int exit, const std::string& message) {
    const auto r = quell(args);
    EXPECT_EQ(r.exit, exit);
    EXPECT_EQ(r.err, message);
    EXPECT_EQ(r.out, "");
  }
};

TEST_F(GraphFiles, TyposArePointedAt) {
  write(
      "shots/typo.json",
      "{\"quell\": 1,\n \"inputs\": {\"color\": \"radiance\"},\n"
      " \"nodes\": {\"a\": {\"type\": \"gaussian\", \"in\": {\"imgae\": \"color\"}}},\n \"outputs\": {\"c\": \"a\"}}");
  expect_error({"check", "shots/typo.json"}, 2,
               "shots/typo.json:3:45: error: a.in.imgae: node type 'gaussian' has no input 'imgae'\n"
               "  it has: image. Did you mean 'image'?\n");
  write("comma.json", "{\"quell\": 1,\n \"nodes\": {},\n}");
  expect_error({"check", "./comma.json"}, 2,
               "./comma.json:3:1: error: expected a key in quotes, found '}'\n"
               "  no comma may follow the last member\n");
}

TEST_F(GraphFiles, EmptyOnesAreNoGraphs) {
  write("empty.json", "{}");
  const auto r = quell({"check", "empty.json"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("empty.json:1:1: error: this is no graph: it does not begin with \"quell\": 1"),
            std::string::npos);
  write("void.json", "");
  expect_error({"check", "void.json"}, 2, "void.json:1:1: error: expected a value, found the end of the file\n");
  expect_error({"run", "/dev/null", "room"}, 2, "/dev/null:1:1: error: expected a value, found the end of the file\n");
  write("none.json", R"({"quell": 1, "nodes": {}, "outputs": {}})");
  const auto none = quell({"check", "none.json"});
  EXPECT_EQ(none.exit, 2);
  EXPECT_NE(none.err.find("a graph needs an output"), std::string::npos) << none.err;
}

TEST_F(GraphFiles, ACycleIsPrinted) {
  write("cycle.json", R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {
    "a": {"type": "outlier_clamp", "in": {"image": "b"}},
    "b": {"type": "outlier_clamp", "in": {"image": "a"}}}, "outputs": {"c": "a"}})");
  const auto r = quell({"check", "cycle.json"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_EQ(r.err.find("cycle.json:"), 0u) << r.err;
  EXPECT_NE(r.err.find("a → b → a"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("@-1"), std::string::npos) << "the way out\n" << r.err;
}

TEST_F(GraphFiles, WhatIsNoFileIsNamed) {
  fs::create_directories(path("folder.json"));
  write("file.json", "{}");
  expect_error({"check", "folder.json"}, 2, "error: cannot read 'folder.json': Is a directory\n");
  expect_error({"check", "file.json/g.json"}, 2, "error: cannot read 'file.json/g.json': Not a directory\n");
  expect_error({"run", "svgf", "folder.json"}, 3, "error: cannot read 'folder.json': Is a directory\n");
  expect_error({"run", "svgf", "file.json/s.json"}, 3, "error: cannot read 'file.json/s.json': Not a directory\n");
}

TEST_F(GraphFiles, AHundredMegabytesOfBracketsAreRefused) {
  std::ofstream(path("deep.json")) << std::string(100'000'000, '[');
  const auto r = quell({"check", "deep.json"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_EQ(r.err, "deep.json:1:65: error: nested deeper than 64 levels\n");
  const auto sequence = quell({"check", "svgf", "deep.json"});
  EXPECT_EQ(sequence.exit, 2);
  EXPECT_EQ(sequence.err, r.err);
}

TEST_F(GraphFiles, TenThousandNodesRun) {
  std::string text = R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {)";
  for (int i = 0; i < 10000; ++i)
    text += fmt::format(R"({}"n{}": {{"type": "modulate", "in": {{"image": "{}", "albedo": "albedo"}}}})",
                        i ? ",\n" : "", i, i ? fmt::format("n{}", i - 1) : "color");
  write("long.json", text + R"(}, "outputs": {"color": "n9999"}})");
  auto r = quell({"check", "long.json"});
  EXPECT_EQ(r.exit, 2) << "it lacks an input";
  EXPECT_NE(r.err.find("more than 100 errors"), std::string::npos) << r.err.substr(0, 500);
  EXPECT_LT(r.err.size(), 100'000u);

  auto fixed = read("long.json");
  fixed.replace(fixed.find(R"("radiance"})"), 11, R"("radiance", "albedo": "albedo"})");
  write("long.json", fixed);
  r = quell({"run", "long.json", "room", "--source", "width=8", "--source", "height=8", "--frames", "0-1", "--quiet"});
  EXPECT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(files("out").size(), 2u);
}

TEST_F(GraphFiles, EveryShippedGraphAndSequenceIsGood) {
  int graphs = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(QUELL_TEST_SOURCE) / "graphs")) {
    if (entry.path().extension() != ".json") continue;
    ++graphs;
    const auto name = entry.path().stem().string();
    const auto r = quell({"check", name});
    EXPECT_EQ(r.exit, 0) << r.err;
    EXPECT_EQ(r.err, "") << name << " has warnings";
    EXPECT_EQ(r.out.find(name + ": good: "), 0u) << r.out;
  }
  EXPECT_GE(graphs, 3);
  for (const auto& entry : fs::directory_iterator(fs::path(QUELL_TEST_SOURCE) / "graphs/sequences")) {
    const auto r = quell({"check", "svgf", entry.path().stem().string()});
    EXPECT_EQ(r.exit, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_NE(r.out.find(" frames: 0-"), std::string::npos) << r.out;
  }
}

// Whole documents among the JSON of the guides: those that say what they are.
TEST_F(GraphFiles, DocumentsInTheGuidesAreValid) {
  int checked = 0;
  for (const char* guide : {"README.md", "docs/graph_format.md", "docs/sequences.md", "docs/cli.md"}) {
    std::ifstream in(fs::path(QUELL_TEST_SOURCE) / guide);
    ASSERT_TRUE(in) << guide;
    std::string block;
    bool inside = false;
    int start = 0, number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      if (!inside && (line == "```json" || line == "```jsonc")) {
        inside = true, start = number, block.clear();
      } else if (inside && line == "```") {
        inside = false;
        const auto parsed = json::parse(block, nullptr, false, true);
        if (!parsed.is_object()) continue;
        SCOPED_TRACE(fmt::format("{}:{}", guide, start));
        if (parsed.contains("quell")) {
          // A variant's base is the installed graph of its name.
          auto text = block;
          if (const auto base = text.find("\"base\": \"");
              base != text.npos && parsed["base"].get<std::string>().find(':') == std::string::npos)
            text.insert(base + 9, "quell:");
          const auto r = quell({"check", write("guide.json", text)});
          EXPECT_EQ(r.exit, 0) << r.err << text;
          ++checked;
        } else if (parsed.contains("quell_sequence")) {
          // Its images are not here: that they are looked for shows that the document itself is good.
          const auto r = quell({"check", "unfiltered", write("guide.json", block)});
          EXPECT_EQ(r.exit, 3) << r.err << block;
          EXPECT_TRUE(r.err.find("there is no such file") != r.err.npos || r.err.find("No such file") != r.err.npos)
              << r.err;
          ++checked;
        }
      } else if (inside) {
        block += line + '\n';
      }
    }
    EXPECT_FALSE(inside) << guide << ":" << start << " does not end";
  }
  EXPECT_GE(checked, 4);
}

TEST_F(GraphFiles, CheckSpeaksJson) {
  write("two.json",
        "{\"quell\": 1, \"inputs\": {\"color\": \"radiance\"},\n \"nodes\": {\n"
        "  \"a\": {\"type\": \"gaussain\", \"in\": {\"image\": \"color\"}},\n"
        "  \"ä\\\"\": {}},\n \"outputs\": {\"c\": \"a\"}}");
  const auto bad = quell({"check", "two.json", "--json", "--set", "alpha"});
  EXPECT_EQ(bad.exit, 2);
  const auto j = json::parse(bad.out);
  EXPECT_EQ(j["quell_check"], 1);
  EXPECT_EQ(j["good"], false);
  EXPECT_EQ(j["exit"], 2);
  ASSERT_FALSE(j["diagnostics"].empty());
  for (const auto& d : j["diagnostics"])
    for (const char* key : {"severity", "file", "line", "column", "path", "text", "notes"})
      EXPECT_TRUE(d.contains(key)) << key;
  EXPECT_NE(bad.err.find("error: "), std::string::npos) << "people still read stderr";

  write("two.json",
        "{\"quell\": 1, \"inputs\": {\"color\": \"radiance\"},\n \"nodes\": {\n"
        "  \"a\": {\"type\": \"gaussain\", \"in\": {\"image\": \"color\"}}},\n \"outputs\": {\"c\": \"a\"}}");
  const auto typo = json::parse(quell({"check", "two.json", "--json"}).out)["diagnostics"].at(0);
  EXPECT_EQ(typo, json::parse(R"({"severity": "error", "file": "two.json", "line": 3, "column": 17, "path": "a.type",
      "text": "there is no node type 'gaussain'", "notes": ["Did you mean 'gaussian'?"]})"));

  const auto good = json::parse(quell({"check", "svgf", "room", "--json"}).out);
  EXPECT_EQ(good["good"], true);
  EXPECT_EQ(good["diagnostics"], json::array());
  EXPECT_EQ(good["graph"]["name"], "SVGF");
  EXPECT_EQ(good["graph"]["frames"].size(), 32u);
  EXPECT_EQ(good["graph"]["outputs"], json::array({"color"}));
  EXPECT_GT(good["graph"]["image_bytes"], 1 << 20);

  const auto gone = quell({"check", "unfiltered", "gone.####.exr", "--json"});
  EXPECT_EQ(gone.exit, 3);
  EXPECT_EQ(json::parse(gone.out)["diagnostics"].at(0)["text"], "no file is called 'gone.####.exr'");
}

TEST_F(GraphFiles, PlanSpeaksJson) {
  const auto r = quell({"plan", "svgf", "--size", "64x36", "--json"});
  ASSERT_EQ(r.exit, 0) << r.err;
  const auto j = json::parse(r.out);
  EXPECT_EQ(j["quell_plan"], 1);
  EXPECT_EQ(j["graph"], "SVGF");
  std::map<std::string, json> nodes, buffers;
  std::vector<std::string> order;
  for (const auto& n : j["nodes"]) nodes[n["name"]] = n, order.push_back(n["name"]);
  for (const auto& b : j["buffers"]) buffers[b["name"]] = b;
  EXPECT_EQ(nodes.at("by_normal")["weight"], true);
  EXPECT_EQ(nodes.at("demodulate")["reach"], json::parse(R"({"rows": 0, "anywhere": false, "step": 1})"));
  EXPECT_EQ(nodes.at("level2.atrous")["reach"]["step"], 4);
  EXPECT_EQ(nodes.at("level2.atrous")["reach"]["rows"], 8);
  EXPECT_LT(std::ranges::find(order, "demodulate"), std::ranges::find(order, "blend"));
  const auto& reads = nodes.at("history")["reads"];
  EXPECT_NE(std::ranges::find(reads, "level0.atrous.image@-1"), reads.end()) << reads;
  EXPECT_EQ(buffers.at("color")["input"], true);
  EXPECT_EQ(buffers.at("color")["channels"], 3);
  EXPECT_EQ(buffers.at("level0.atrous.image")["delay"], 1);
  EXPECT_TRUE(buffers.at("level0.atrous.image").contains("ring"));
  EXPECT_TRUE(buffers.at("slope.slope").contains("arena"));
  const auto ring = buffers.at("level0.atrous.image"), alone = buffers.at("level0.atrous.variance");
  EXPECT_EQ(nodes.at("level0.atrous")["bytes"],
            2 * ring["slot_bytes"].get<std::size_t>() + alone["slot_bytes"].get<std::size_t>());
  EXPECT_EQ(nodes.at("by_normal")["bytes"], 0);
  EXPECT_EQ(j["bytes"]["all"], j["bytes"]["arena"].get<std::size_t>() + j["bytes"]["rings"].get<std::size_t>());
  EXPECT_GE(j["bytes"]["without_reuse"], j["bytes"]["all"]);
}

}  // namespace
}  // namespace quell::test
