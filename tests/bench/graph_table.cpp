// All shipped graphs in one Markdown table: what each takes for a frame and how good its pictures are, over the
// built-in scenes and, where QUELL_TEST_DATA names its folder, over the Cycles room.
//
//   graph_table FOLDER [VARIATION…]
//
// FOLDER keeps the references, which take minutes to trace; the first run fills it. A variation stands for all graphs:
// "svgf set alpha=0.2 wire history.image=blend@-1". Times are those of filtering alone, on as many threads as
// there are cores: a frame's share of the fastest of several rounds in which the graphs take turns.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/run/executor.h"
#include "tests/bench/turns.h"
#include "tests/support/data_sequence.h"
#include "tests/support/judged_frames.h"
#include "tests/support/paths.h"
#include "tests/support/run_shipped.h"
#include "tests/support/trace_room.h"

namespace quell::bench {
namespace {

constexpr int kWidth = 480, kHeight = 270, kSamples = 128, kRounds = 5;

struct Variation {
  std::string text, graph;
  std::vector<Edit> edits;
};

Variation parse(const std::string& text) {
  const std::map<std::string, Edit::Kind> kinds = {
      {"set", Edit::Kind::set}, {"swap", Edit::Kind::swap}, {"wire", Edit::Kind::wire}, {"bypass", Edit::Kind::bypass}};
  Variation v{text, {}, {}};
  std::istringstream words(text);
  words >> v.graph;
  for (std::string kind, value; words >> kind;) {
    if (!kinds.contains(kind) || !(words >> value))
      throw std::invalid_argument(
          text + ": expected GRAPH and pairs of set, swap, wire or bypass and what it takes, not '" + kind + "'");
    v.edits.push_back({kinds.at(kind), value});
  }
  return v;
}

struct Sequence {
  std::string name;
  test::JudgedFrames frames;
};

// One half of a frame's reference: from the folder, or traced and left there.
Image half(const std::filesystem::path& folder, const std::string& scene, std::int64_t frame, int seed) {
  const auto file = folder / (scene + "_" + std::to_string(frame) + "_" + std::to_string(seed) + ".floats");
  Image image(kWidth, kHeight, 3);
  const auto each_row = [&](auto use) {
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        use(reinterpret_cast<char*>(image.row(c, y)), kWidth * std::streamsize(sizeof(float)));
  };
  if (std::ifstream in(file, std::ios::binary); in) {
    each_row([&](char* row, std::streamsize bytes) { in.read(row, bytes); });
    if (in) return image;
  }
  const auto traced = test::trace_scene(scene, {frame}, {}, {kSamples, seed, kWidth, kHeight});
  image = test::KeptFrames(*traced, {"color"}).image(frame, "color").copy();
  std::ofstream out(file, std::ios::binary);
  each_row([&](const char* row, std::streamsize bytes) { out.write(row, bytes); });
  return image;
}

test::JudgedFrames scene(const std::filesystem::path& folder, const std::string& name, std::int64_t first,
                         const std::set<std::int64_t>& cuts, const std::vector<std::int64_t>& judged) {
  std::vector<std::int64_t> frames;
  for (std::int64_t f = first; f < first + 16; ++f) frames.push_back(f);
  std::map<std::int64_t, test::ReferenceHalves> references;
  for (const auto f : judged) references[f] = {half(folder, name, f, 1001), half(folder, name, f, 1002)};
  const auto source = test::trace_scene(name, frames, cuts, {1, 0, kWidth, kHeight});
  return {test::KeptFrames(*source), std::move(references)};
}

class Discard : public FrameSink {
 public:
  void write(std::int64_t, std::span<const quell_image>) override {}
};

// A frame's share of the fastest round.
std::vector<Cost> times(const std::vector<Variation>& variations, FrameSource& frames) {
  std::vector<Cost> least(variations.size());
  for (int round = -1; round < kRounds; ++round)
    for (std::size_t i = 0; i < variations.size(); ++i) {
      const Graph graph = test::shipped_graph(variations[i].graph, variations[i].edits, &frames.roles());
      Discard sink;
      RunOptions options;
      options.overlap = false;
      const RunReport report = run_graph(graph, frames, sink, options);
      const Cost cost{report.filter_wall / double(report.frames), report.filter_cpu / double(report.frames)};
      if (round >= 0 && cost.wall < least[i].wall) least[i] = cost;
    }
  return least;
}

void print_table(const std::vector<Variation>& variations, std::vector<Sequence>& sequences) {
  const auto costs = times(variations, sequences[0].frames.frames());
  std::printf("| graph | ms | CPU ms |");
  for (const auto& [name, sequence] : sequences) std::printf(" %s |", name.c_str());
  std::printf("\n|---|---|---|");
  for (std::size_t i = 0; i < sequences.size(); ++i) std::printf("---|");
  for (std::size_t i = 0; i < variations.size(); ++i) {
    const auto& v = variations[i];
    std::printf("\n| `%s` | %.1f | %.1f |", v.text.c_str(), 1e3 * costs[i].wall, 1e3 * costs[i].cpu);
    for (auto& [name, sequence] : sequences) try {
        const auto q = sequence.judge(sequence.run(v.graph, v.edits));
        std::printf(" %.2f · %.3g · %.2f · %+.1f %% |", q.psnr, q.relative_error, q.flicker, 100 * q.brightness_error);
      } catch (const std::exception& e) {  // most likely a role that the sequence has not
        std::cerr << v.text << " over " << name << ": " << e.what() << "\n";
        std::printf(" – |");
      }
    std::fflush(stdout);
  }
  std::printf("\n");
}

}  // namespace
}  // namespace quell::bench

int main(int argc, char** argv) try {
  using namespace quell;
  if (argc < 2) {
    std::cerr << "usage: graph_table FOLDER [VARIATION…]\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  std::vector<bench::Variation> variations;
  for (int i = 2; i < argc; ++i) variations.push_back(bench::parse(argv[i]));
  if (variations.empty())
    for (const auto& name : installed_graphs(QUELL_TEST_SOURCE "/graphs")) variations.push_back(bench::parse(name));
  std::vector<bench::Sequence> sequences;
  sequences.push_back({"`room`", bench::scene(folder, "room", 0, {}, {4, 8, 12, 15})});
  sequences.push_back({"`arcade`", bench::scene(folder, "arcade", 4, {16}, {9, 12, 15, 19})});
  if (test::has_data()) sequences.push_back({"Cycles room", test::judged_cycles_cornell()});
  bench::print_table(variations, sequences);
} catch (const std::exception& e) {
  std::cerr << "graph_table: " << e.what() << "\n";
  return 1;
}
