// Motion computed from the matrices of real sequences: against values of the GAMES202 box, and against what a renderer
// wrote.
#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/data_sequence.h"
#include "tests/support/run_node.h"

namespace quell::test {
namespace {

// From the guide on `port`, position or depth, between two frames.
Image motion_between(DataSequence& sequence, int before, int now, const char* port) {
  const auto guide = sequence.read(now, port), id = sequence.read(now, "id");
  const auto camera = sequence.read(now, "camera"), camera_before = sequence.read(before, "camera");
  const auto transforms = sequence.read(now, "transforms"), transforms_before = sequence.read(before, "transforms");
  return Node("motion_vectors")
      .in(port, guide)
      .in("id", id)
      .in("camera", camera)
      .in("camera_before", camera_before)
      .in("transforms", transforms)
      .in("transforms_before", transforms_before)
      .run("motion");
}

TEST(Games202, Motion) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  DataSequence box("games202-box", "games202-box");
  const auto motion = motion_between(box, 0, 1, "position"), rebuilt = motion_between(box, 0, 1, "depth");
  struct Golden {
    int x, y;
    double dx, dy;
  };
  for (const auto& g :
       {Golden{260, 208, -19.1710, 0.0769}, {273, 208, -20.2523, -0.1118}, {286, 208, -17.7859, -0.3282}}) {
    EXPECT_NEAR(motion.at(0, g.x, g.y), g.dx, 1e-3);
    EXPECT_NEAR(motion.at(1, g.x, g.y), g.dy, 1e-3);
  }
  double longest = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      longest = std::max(longest, std::hypot(double(motion.at(0, x, y)), double(motion.at(1, x, y))));
      ASSERT_NEAR(motion.at(0, x, y), rebuilt.at(0, x, y), 1e-3) << x << ',' << y;
      ASSERT_NEAR(motion.at(1, x, y), rebuilt.at(1, x, y), 1e-3) << x << ',' << y;
    }
  EXPECT_NEAR(longest, 30.555, 1e-3);
}

TEST(Games202, ValidHistory) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  DataSequence box("games202-box", "games202-box");
  const auto motion = motion_between(box, 0, 1, "position"), id = box.read(1, "id"), id_before = box.read(0, "id");
  const auto taps = Node("disocclusion")
                        .set("mode", "nearest")
                        .set("fallback", false)
                        .in("motion", motion)
                        .in("id", id)
                        .in("id_before", id_before)
                        .run("taps");
  int valid = 0, background = 0, mismatch = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      const bool miss = id.bits(0, y)[x] == kNoId;
      const bool found = taps.at(0, x, y) + taps.at(1, x, y) + taps.at(2, x, y) + taps.at(3, x, y) > 0;
      background += miss, valid += !miss && found, mismatch += !miss && !found;
    }
  EXPECT_EQ(background, 14140);
  EXPECT_EQ(valid, 246456);
  EXPECT_EQ(mismatch, 1548);
}

// A dolly, and a cube that travels and turns: what Cycles writes as motion, computed from its cameras and objects.
TEST(CyclesCornell, Motion) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  DataSequence room("cycles-cornell", "cycles-cornell");
  const auto ours = motion_between(room, 7, 8, "depth"), theirs = room.read(8, "motion");
  std::vector<double> apart;
  double longest = 0;
  for (int y = 0; y < ours.height(); ++y)
    for (int x = 0; x < ours.width(); ++x) {
      const double dx = theirs.at(0, x, y), dy = theirs.at(1, x, y);
      longest = std::max(longest, std::hypot(dx, dy));
      apart.push_back(std::hypot(ours.at(0, x, y) - dx, ours.at(1, x, y) - dy));
    }
  std::sort(apart.begin(), apart.end());
  EXPECT_GT(longest, 10);
  EXPECT_LT(apart[apart.size() / 2], 0.01);
  EXPECT_LT(apart[apart.size() * 99 / 100], 0.05);
}

}  // namespace
}  // namespace quell::test
