// A hard cut that the sequence does not declare, found by what it disoccludes.
#include <gtest/gtest.h>

#include "tests/support/data_sequence.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"
#include "tests/support/run_sequence.h"
#include "tests/support/trace_room.h"

namespace quell::test {
namespace {

// Share of pixels of a frame that show what the frame before did not.
float share_of_new(const std::vector<Image>& now, const std::vector<Image>& before) {
  Node slope("depth_slope"), taps("disocclusion"), share("disoccluded_share");
  const auto slopes = slope.in("depth", now[1]).run("slope");
  taps.in("motion", now[0]).in("slope", slopes);
  taps.in("depth", now[1]).in("depth_before", before[1]).in("normal", now[2]).in("normal_before", before[2]);
  const auto valid = taps.in("id", now[3]).in("id_before", before[3]).run("taps");
  return share.in("taps", valid).run("share").at(0, 0, 0);
}

TEST(UndeclaredCut, IsWhereNearlyAllIsNew) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  DataSequence foliage("cycles-native-foliage-undeclared", "cycles-native");
  const auto guides = [&](int frame) {
    std::vector<Image> images;
    for (const char* role : {"motion", "depth", "normal", "id"}) images.push_back(foliage.read(frame, role));
    return images;
  };
  const auto f7 = guides(7), f8 = guides(8), f9 = guides(9), f10 = guides(10);
  const float usual = share_of_new(f8, f7), cut = share_of_new(f9, f8), after = share_of_new(f10, f9);
  // Thin leaves disocclude a fifth in any frame, and sky on both sides of the cut looks like the same sky.
  EXPECT_GT(cut, 0.65f);
  EXPECT_LT(usual, 0.25f);
  EXPECT_LT(after, 0.25f);
}

TEST(UndeclaredCut, DropsAllHistory) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  const auto run = [](std::vector<Edit> edits) {
    return run_sequence({.graph = "temporal_accumulation",
                         .sequence = QUELL_TEST_SOURCE "/tests/data_sequences/cycles-native-foliage-undeclared.json",
                         .root = test_data() + "/cycles-native",
                         .edits = std::move(edits)});
  };
  DataSequence foliage("cycles-native-foliage-undeclared", "cycles-native");
  const auto gated = run({}), open = run({{Edit::Kind::set, "cut_threshold=1"}});
  EXPECT_FALSE(same_bits(open.images.at(9)[0], gated.images.at(9)[0])) << "the gate had nothing to do";
  EXPECT_EQ(gated.report.resets, 1u) << "of the first frame alone";
  EXPECT_TRUE(same_bits(gated.images.at(9)[0], foliage.read(9, "color"))) << "some history crossed the cut";
  for (const int frame : {8, 10})
    EXPECT_FALSE(same_bits(gated.images.at(frame)[0], foliage.read(frame, "color"))) << "no history in frame " << frame;
}

// A moving camera, a tumbling cube, railings: far from a cut.
TEST(UndeclaredCut, TheRoomHasNone) {
  const auto guides = [](std::int64_t frame) {
    return trace_room({frame, 1, 0, 120, 68}, {"motion", "depth", "normal", "id"});
  };
  auto before = guides(0);
  for (std::int64_t frame = 1; frame < 8; ++frame) {
    auto now = guides(frame);
    EXPECT_LT(share_of_new(now, before), 0.2f) << frame;
    before = std::move(now);
  }
}

}  // namespace
}  // namespace quell::test
