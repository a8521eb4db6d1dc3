// The built-in sequences: each runs, shows something, and changes where its comment says that it does.
#include "tests/support/paths.h"
#include "tests/support/picture_metrics.h"
#include "tests/support/run_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

namespace quell::test {
namespace {

const std::filesystem::path kSequences = QUELL_TEST_SOURCE "/graphs/sequences";

SequenceResult run(const std::string& graph, const std::string& sequence, const std::string& frames, int width = 96,
                   int spp = 1, int seed = 0) {
  return run_sequence({.graph = graph,
                       .sequence = (kSequences / (sequence + ".json")).string(),
                       .frames = frames,
                       .source_ints = {{"width", width}, {"height", width * 9 / 16}, {"spp", spp}, {"seed", seed}}});
}

// PSNR of each of three results in one frame: of the input, of svgf and of recommended.
struct Scores {
  double input, svgf, recommended;
};

Scores scores(const std::string& sequence, const std::string& frames, int frame) {
  constexpr int kWidth = 192, kSpp = 32;
  const auto n = std::to_string(frame);
  const auto a = run("unfiltered", sequence, n, kWidth, kSpp, 1001),
             b = run("unfiltered", sequence, n, kWidth, kSpp, 2002);
  const auto of = [&](const std::string& graph, const std::string& over) {
    return psnr(run(graph, sequence, over, kWidth).images.at(frame)[0], {a.images.at(frame)[0], b.images.at(frame)[0]});
  };
  return {of("unfiltered", n), of("svgf", frames), of("recommended", frames)};
}

bool same(const Image& a, const Image& b) {
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * sizeof(float)) != 0) return false;
  return true;
}

double mean(const Image& image) {
  double sum = 0;
  for (int c = 0; c < image.channels(); ++c)
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) sum += double(image.at(c, x, y));
  return sum / (image.channels() * image.width() * image.height());
}

TEST(BuiltInSequences, RunAndShowSomething) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kSequences)) names.insert(entry.path().stem().string());
  EXPECT_TRUE(names.contains("room") && names.contains("hall") && names.contains("yard"));
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    const auto result = run("recommended", name, "0-1");
    ASSERT_EQ(result.images.size(), 2u);
    for (const auto& [frame, images] : result.images) {
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 54; ++y)
          for (int x = 0; x < 96; ++x) ASSERT_TRUE(std::isfinite(images[0].at(c, x, y)));
      EXPECT_GT(mean(images[0]), 0.03);
    }
  }
}

// The yard's cut, declared, starts anew; undeclared, the gate of temporal_accumulation finds it, in the very frame and
// in no other.
TEST(BuiltInSequences, TheYardsCutIsFoundWhereItIs) {
  const auto raw = run("unfiltered", "yard", "6-9"), declared = run("temporal_accumulation", "yard", "6-9"),
             found = run("temporal_accumulation", "yard_undeclared", "6-9");
  EXPECT_EQ(declared.report.resets, 2u);
  EXPECT_EQ(found.report.resets, 1u) << "of the first frame alone";
  for (const int frame : {7, 9}) EXPECT_FALSE(same(found.images.at(frame)[0], raw.images.at(frame)[0])) << frame;
  for (const auto* r : {&declared, &found}) EXPECT_TRUE(same(r->images.at(8)[0], raw.images.at(8)[0]));
}

// Behind rough metal normals are noise: taken as they come they keep every pixel to itself, over space and over time.
TEST(BuiltInSequences, TheHallIsCleanDespiteNoiseInItsFeatures) {
  const auto s = scores("hall", "0-7", 7);
  RecordProperty("gains", std::to_string(s.svgf - s.input) + " " + std::to_string(s.recommended - s.input));
  EXPECT_GT(s.recommended, s.input + 7);
  EXPECT_GT(s.recommended, s.svgf + 2);
}

// In the frame in which the lantern switches on, history is of no use, and a frame later it is again.
TEST(BuiltInSequences, TheYardsLanternComesOnAtOnce) {
  for (const int frame : {12, 13}) {
    const auto s = scores("yard", "8-" + std::to_string(frame), frame);
    RecordProperty("gains_" + std::to_string(frame),
                   std::to_string(s.svgf - s.input) + " " + std::to_string(s.recommended - s.input));
    EXPECT_GT(s.recommended, s.input + 5) << frame;
    EXPECT_GT(s.recommended, s.svgf + 3) << frame;
  }
}

}  // namespace
}  // namespace quell::test
