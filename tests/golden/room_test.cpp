// SVGF and the recommended graph over the built-in room: how much they gain, that neither leaves blotches nor ghosts,
// and that neither threads, bands nor chunks change a bit.
#include "tests/support/paths.h"
#include "tests/support/run_node.h"
#include "tests/support/run_sequence.h"
#include "tests/support/trace_room.h"

#include <gtest/gtest.h>
#include <quell/types.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace quell::test {
namespace {

constexpr int kWidth = 240, kHeight = 135;

SequenceRun room(const std::string& frames, const std::string& graph = "svgf") {
  return {.graph = graph,
          .sequence = QUELL_TEST_SOURCE "/graphs/sequences/room.json",
          .frames = frames,
          .source_ints = {{"width", kWidth}, {"height", kHeight}}};
}

std::vector<Image> trace(std::int64_t frame, int spp, int seed, const std::vector<std::string>& roles) {
  return trace_room({frame, spp, seed, kWidth, kHeight}, roles);
}

double tone(float x) { return double(x) / (1.0 + double(x)); }

// -10 log10 mean((T(X) - T(A)) (T(X) - T(B))): the noise of two independent references cancels. Over pixels where `use`
// says so.
template <class Use>
double psnr(const Image& x, const Image& a, const Image& b, Use use) {
  double sum = 0;
  long count = 0;
  for (int y = 0; y < x.height(); ++y)
    for (int u = 0; u < x.width(); ++u) {
      if (!use(u, y)) continue;
      for (int c = 0; c < 3; ++c)
        sum += (tone(x.at(c, u, y)) - tone(a.at(c, u, y))) * (tone(x.at(c, u, y)) - tone(b.at(c, u, y)));
      count += 3;
    }
  return -10 * std::log10(std::max(sum, 1e-12) / double(count));
}

TEST(Room, SvgfGainsEightDecibelsAndRecommendedMore) {
  const auto result = run_sequence(room("0-15")), recommended = run_sequence(room("0-15", "recommended"));
  for (const std::int64_t frame : {8, 15}) {
    const auto noisy = trace(frame, 1, 0, {"color"});
    const auto a = trace(frame, 64, 1001, {"color"}), b = trace(frame, 64, 1002, {"color", "motion", "id"});
    const auto everywhere = [](int, int) { return true; };
    const double before = psnr(noisy[0], a[0], b[0], everywhere),
                 after = psnr(result.images.at(frame)[0], a[0], b[0], everywhere);
    RecordProperty("before_" + std::to_string(frame), std::to_string(before));
    RecordProperty("after_" + std::to_string(frame), std::to_string(after));
    EXPECT_GE(after, before + 8) << "frame " << frame;
    const double best = psnr(recommended.images.at(frame)[0], a[0], b[0], everywhere);
    RecordProperty("recommended_" + std::to_string(frame), std::to_string(best));
    EXPECT_GE(best, after + 0.8) << "frame " << frame;

    // A ghost lies where something else was a frame ago: pixels whose motion leads to another object. They are young,
    // so they are worse than the rest, but still far better than the input.
    const auto before_ids = trace(frame - 1, 1, 0, {"id"});
    const auto uncovered = [&](int x, int y) {
      const int u = int(std::floor(float(x) + 0.5f + b[1].at(0, x, y))),
                v = int(std::floor(float(y) + 0.5f + b[1].at(1, x, y)));
      return u >= 0 && v >= 0 && u < kWidth && v < kHeight && before_ids[0].bits(0, v)[u] != b[2].bits(0, y)[x];
    };
    for (const auto* run : {&result, &recommended})
      EXPECT_GE(psnr(run->images.at(frame)[0], a[0], b[0], uncovered), psnr(noisy[0], a[0], b[0], uncovered) + 5)
          << "frame " << frame;
  }
}

TEST(Room, ThreadsAndBandsChangeNoBit) {
  for (const char* graph : {"svgf", "recommended", "games202"}) {
    auto run = room("0-3", graph);
    run.options.threads = 1;
    const auto expected = run_sequence(run);
    for (const int threads : {1, 2, 4})
      for (const int rows : {1, 7, 64, 100000}) {
        if (std::string(graph) == "games202" && threads == 1) continue;  // a large window takes its time
        run.options.threads = threads, run.options.band_rows = rows;
        const auto result = run_sequence(run);
        for (const auto& [frame, images] : expected.images)
          EXPECT_TRUE(same_bits(images[0], result.images.at(frame)[0]))
              << graph << " " << frame << " threads " << threads << " rows " << rows;
      }
  }
}

TEST(Room, ChunksChangeNoBit) {
  const auto path = std::filesystem::temp_directory_path() / ("quell_room_" + std::to_string(getpid()));
  for (const char* graph : {"svgf", "recommended"}) {
    const auto whole = run_sequence(room("0-9", graph));
    auto first = room("0-4", graph), second = room("5-9", graph);
    first.options.save_state = path;
    second.options.load_state = path;
    const auto a = run_sequence(first), b = run_sequence(second);
    std::filesystem::remove(path);
    EXPECT_EQ(b.report.resets, 0u);
    for (std::int64_t f = 0; f < 10; ++f)
      EXPECT_TRUE(same_bits(whole.images.at(f)[0], (f < 5 ? a : b).images.at(f)[0])) << graph << " " << f;
  }
}

TEST(Room, EveryImageIsFinite) {
  for (const char* graph : {"svgf", "recommended", "games202"})
    for (const auto& [frame, images] : run_sequence(room("0-2", graph)).images)
      for (const auto& image : images)
        for (int c = 0; c < image.channels(); ++c)
          for (int y = 0; y < image.height(); ++y)
            EXPECT_TRUE(std::all_of(image.row(c, y), image.row(c, y) + image.width(),
                                    [](float v) { return std::isfinite(v); }));
}

}  // namespace
}  // namespace quell::test
