// Picture quality of SVGF, of its variations and of the recommended graph on a path-traced room with references, scored
// as picture_metrics.h says over frames 4, 8, 15 and 16.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/data_sequence.h"
#include "tests/support/judged_frames.h"
#include "tests/support/scratch.h"

namespace quell::test {
namespace {

using enum Edit::Kind;

class CyclesQuality : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  }
  static Quality quality(const std::string& graph, std::vector<Edit> edits) {
    static JudgedFrames room = judged_cycles_cornell();
    const Quality q = room.judge(room.run(graph, std::move(edits)));
    RecordProperty("psnr", std::to_string(q.psnr));
    RecordProperty("flicker", std::to_string(q.flicker));
    return q;
  }
};

TEST_F(CyclesQuality, DefaultsReachTheirQuality) {
  const auto q = quality("svgf", {});
  EXPECT_GE(q.psnr, 40.5);
  EXPECT_LE(q.flicker, 1.5);
}

TEST_F(CyclesQuality, RecommendedReachesItsQuality) {
  const auto q = quality("recommended", {});
  EXPECT_GE(q.psnr, 43.0);
  EXPECT_LE(q.flicker, 1.3);
}

// What follows is SVGF as the paper has it and, one after the other, what improves it. The numbers are those of an
// independent implementation in double precision on these frames, which ours must be within 0.3 dB of.
std::vector<Edit> papers(std::vector<Edit> more) {
  more.insert(more.end(), {{set, "alpha=0.2"}, {set, "min_count=4"}});
  return more;
}

TEST_F(CyclesQuality, ThePapersParametersAndTheUsualDemodulation) {
  const auto q = quality("svgf", papers({{set, "demodulation=classic"}, {set, "emitters=keep"}}));
  EXPECT_NEAR(q.psnr, 37.4, 0.3);
  EXPECT_LE(q.flicker, 1.9);
}

TEST_F(CyclesQuality, AlbedoClippedAndEmittersPassed) { EXPECT_NEAR(quality("svgf", papers({})).psnr, 40.8, 0.3); }

TEST_F(CyclesQuality, HistoryNotFiltered) {
  EXPECT_NEAR(quality("svgf", papers({{wire, "history.image=blend@-1"}})).psnr, 41.6, 0.3);
}

TEST_F(CyclesQuality, HistoryNotFilteredAndAntiLag) {
  const Scratch scratch;
  const auto graph = scratch.path("anti_lag.json");
  std::ofstream(graph) << R"({
    "quell": 1,
    "base": "svgf",
    "nodes": {
      "history": { "in": { "image": "blend@-1" } },
      "settled": { "type": "anti_lag", "in": { "current": "demodulate", "history": "history", "count": "age" } },
      "age":     { "in": { "before": "settled@-1" } },
      "blend":   { "in": { "count": "settled" } },
      "moments": { "in": { "count": "settled" } },
      "variance": { "in": { "count": "settled" } }
    }
  })";
  EXPECT_NEAR(quality(graph, papers({})).psnr, 41.7, 0.3);
}

}  // namespace
}  // namespace quell::test
