// What has just come into view of the room, averaged from far around or left as noisy as it came.
#include "tests/support/paths.h"
#include "tests/support/run_sequence.h"
#include "tests/support/scratch.h"
#include "tests/support/trace_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace quell::test {
namespace {

constexpr int kWidth = 192, kHeight = 108;
constexpr std::int64_t kFrame = 11;

// Accumulated light, and the same with young pixels fixed; how old they are.
constexpr char kGraph[] = R"({
  "quell": 1,
  "base": "temporal_accumulation",
  "inputs": { "albedo": "albedo", "emission": "radiance" },
  "nodes": {
    "surfaces":   { "type": "split_emitters", "in": { "image": "color", "emission": "emission", "normal": "normal", "depth": "depth" } },
    "demodulate": { "type": "demodulate", "in": { "image": "surfaces.image", "albedo": "albedo" } },
    "blend":      { "in": { "current": "demodulate" } },
    "by_normal":  { "type": "normal_weight", "in": { "normal": "surfaces.normal" }, "set": { "power": 8 } },
    "by_depth":   { "type": "depth_weight", "in": { "depth": "surfaces.depth", "slope": "slope" } },
    "fix":        { "type": "history_fix", "in": { "image": "blend", "count": "age", "weights": ["by_normal", "by_depth"] } }
  },
  "outputs": { "color": "blend", "fixed": "fix", "age": "age" }
})";

TEST(HistoryFix, HelpsWhatHasJustComeIntoView) {
  const Scratch scratch;
  std::ofstream(scratch.path("fix.json")) << kGraph;
  const auto result = run_sequence({.graph = scratch.path("fix.json"),
                                    .sequence = QUELL_TEST_SOURCE "/graphs/sequences/room.json",
                                    .frames = "0-11",
                                    .source_ints = {{"width", kWidth}, {"height", kHeight}}});
  const Image &light = result.images.at(kFrame)[0], &fixed = result.images.at(kFrame)[1],
              &age = result.images.at(kFrame)[2];
  ASSERT_EQ(result.names, (std::vector<std::string>{"color", "fixed", "age"}));
  const auto clean = trace_room({kFrame, 256, 7, kWidth, kHeight}, {"diffuse", "specular", "albedo", "emission"});
  const auto tone = [](double v) { return v / (1 + v); };
  double before = 0, after = 0, young = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (age.at(0, x, y) > 3) {
        EXPECT_EQ(light.at(0, x, y), fixed.at(0, x, y)) << "old, and changed";
        continue;
      }
      if (clean[3].at(0, x, y) > 0) continue;
      ++young;
      for (int c = 0; c < 3; ++c) {
        const double albedo = std::clamp(double(clean[2].at(c, x, y)), 0.1, 1.0);
        const double expected = tone((clean[0].at(c, x, y) + clean[1].at(c, x, y)) / albedo);
        before += std::pow(tone(light.at(c, x, y)) - expected, 2);
        after += std::pow(tone(fixed.at(c, x, y)) - expected, 2);
      }
    }
  EXPECT_GT(young, 100);
  RecordProperty("decibels", std::to_string(10 * std::log10(before / after)));
  EXPECT_GT(10 * std::log10(before / after), 2.5);
}

}  // namespace
}  // namespace quell::test
