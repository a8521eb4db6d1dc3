// The graphs that ship: each loads, and those with real frames to run on reach their quality.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/support/data_sequence.h"
#include "tests/support/run_node.h"
#include "tests/support/run_shipped.h"

namespace quell::test {
namespace {

TEST(ShippedGraphs, Load) {
  const auto names = installed_graphs(std::filesystem::path(QUELL_TEST_SOURCE) / "graphs");
  EXPECT_GE(names.size(), 2u);
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    EXPECT_NO_THROW(shipped_graph(name));
  }
}

// PSNR of tone-mapped x/(1+x) against two independent references, whose own noise cancels; mean over frames with
// references.
double quality(const std::vector<Edit>& edits) {
  DataSequence room("cycles-cornell", "cycles-cornell"), references("cycles-cornell", "cycles-cornell");
  const auto& with_reference = room.files().reference_frames();
  double sum = 0;
  int frames = 0;
  run_shipped("svgf", edits, room.files(), [&](std::int64_t frame, const FrameOutputs& outputs) {
    if (std::find(with_reference.begin(), with_reference.end(), frame) == with_reference.end()) return;
    const auto a = references.read(frame, "reference_a"), b = references.read(frame, "reference_b");
    const auto& color = outputs.at("color");
    const auto mapped = [](double v) { return v / (1 + v); };
    double error = 0;
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < color.height; ++y)
        for (int x = 0; x < color.width; ++x) {
          const double v = mapped(color.plane[c][y * color.pitch + x]);
          error += (v - mapped(a.at(c, x, y))) * (v - mapped(b.at(c, x, y)));
        }
    sum += -10 * std::log10(error / (3.0 * color.width * color.height));
    ++frames;
  });
  EXPECT_EQ(frames, 4);
  return sum / frames;
}

TEST(ShippedGraphs, SvgfReachesItsQuality) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  using enum Edit::Kind;
  const double ours = quality({});
  const double usual = quality({{set, "demodulation=classic"}, {set, "emitters=keep"}});
  EXPECT_GE(ours, 40.5);
  EXPECT_GE(usual, 37.0);
  EXPECT_GE(ours, usual + 2) << "clipped demodulation and emitters set aside must pay";
}

}  // namespace
}  // namespace quell::test
