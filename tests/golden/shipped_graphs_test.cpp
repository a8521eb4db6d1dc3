// The graphs that ship, all of them: each loads, and each beats its input over the built-in room in every measure.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/judged_frames.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"
#include "tests/support/run_shipped.h"

namespace quell::test {
namespace {

std::vector<std::string> all_graphs() { return installed_graphs(std::filesystem::path(QUELL_TEST_SOURCE) / "graphs"); }

TEST(ShippedGraphs, Load) {
  const auto names = all_graphs();
  EXPECT_GE(names.size(), 2u);
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    EXPECT_NO_THROW(shipped_graph(name));
  }
}

struct Gain {
  double decibels = 0, error = 1, flicker = 1;  // more than; less than this share of the input's
};

// Of those that ought to gain more than anything.
const std::map<std::string, Gain> kGains = {
    {"temporal_accumulation", {5.5, 0.15, 0.25}},
    {"dual_rate_accumulation", {5.5, 0.15, 0.25}},
    {"taa", {4, 0.15, 0.15}},
    {"eaw", {8, 0.8, 0.35}},
    {"joint_bilateral", {9, 0.05, 0.4}},
    {"separable_bilateral", {9, 0.05, 0.4}},
    {"svgf_falcor", {9, 0.04, 0.2}},
    {"svgf", {10, 0.035, 0.2}},
    {"svgf_dual", {10, 0.035, 0.2}},
    {"recommended", {10.5, 0.03, 0.2}},
};

TEST(ShippedGraphs, BeatTheirInput) {
  auto room = judged_scene("room", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, {}, {5, 11}, 64, 192, 108);
  Pictures noisy;
  for (const auto frame : room.frames().frames()) noisy[frame] = room.frames().image(frame, "color").copy();
  const Quality input = room.judge(noisy);
  for (const auto& name : all_graphs()) {
    SCOPED_TRACE(name);
    const auto made = room.run(name);
    if (shipped_graph(name).nodes.empty()) {  // its output is its input
      EXPECT_TRUE(same_bits(made.at(11), noisy.at(11)));
      continue;
    }
    const Quality quality = room.judge(made);
    const auto known = kGains.find(name);
    const Gain least = known == kGains.end() ? Gain{} : known->second;
    const double decibels = quality.psnr - input.psnr, error = quality.relative_error / input.relative_error,
                 flicker = quality.flicker / input.flicker;
    RecordProperty(name, std::to_string(decibels) + " " + std::to_string(error) + " " + std::to_string(flicker));
    EXPECT_GT(decibels, least.decibels);
    EXPECT_LT(error, least.error);
    EXPECT_LT(flicker, least.flicker);
  }
}

}  // namespace
}  // namespace quell::test
