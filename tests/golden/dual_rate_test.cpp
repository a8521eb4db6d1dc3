// Light that changes under noise: the slow history of parts/dual_rate.json follows it as far as the fast one does, and
// is otherwise as quiet as a slow one.
#include "core/graph/load.h"
#include "core/run/executor.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace quell::test {
namespace {

constexpr int kSize = 64;
constexpr std::int64_t kStep = 24, kFrames = 33;

// A still wall under noise of ±50 %, three times as bright from frame kStep on.
class Wall : public FrameSource {
 public:
  Wall() {
    for (std::int64_t f = 0; f < kFrames; ++f) frames_.push_back(f);
  }
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return frame == 0; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string> roles) override {
    std::vector<quell_shape> shapes;
    for (const auto& role : roles) shapes.push_back({kSize, kSize, type_info(roles_.at(role))->channels});
    return shapes;
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    const float light = frame < kStep ? 1.0f : 3.0f;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      const Image image = roles[i] == "color"    ? noise_image(kSize, kSize, 3, std::uint32_t(frame) * 7919 + 1,
                                                               0.5f * light, 1.5f * light)
                          : roles[i] == "normal" ? constant_image(kSize, kSize, 3, std::sqrt(1.0f / 3))
                          : roles[i] == "depth"  ? constant_image(kSize, kSize, 1, 4)
                                                 : constant_image(kSize, kSize, into[i].channels, 0);
      for (int c = 0; c < into[i].channels; ++c)
        for (int y = 0; y < kSize; ++y) std::copy_n(image.row(c, y), kSize, into[i].plane[c] + y * into[i].pitch);
    }
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  std::vector<std::int64_t> frames_;
  std::map<std::string, int> roles_{
      {"color", QUELL_RADIANCE}, {"normal", QUELL_NORMAL}, {"depth", QUELL_DEPTH}, {"motion", QUELL_MOTION}};
};

struct Level {
  double mean, deviation;
};

// Mean and standard deviation of each output over the image, for every frame.
class Levels : public FrameSink {
 public:
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    for (const auto& o : outputs) {
      double sum = 0, squares = 0;
      const double n = 3.0 * kSize * kSize;
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kSize; ++y)
          for (int x = 0; x < kSize; ++x) {
            const double v = o.plane[c][y * o.pitch + x];
            sum += v, squares += v * v;
          }
      at[frame].push_back({sum / n, std::sqrt(squares / n - sum * sum / (n * n))});
    }
  }
  std::map<std::int64_t, std::vector<Level>> at;
};

TEST(DualRate, IsQuietAndDoesNotLag) {
  GraphRequest request;
  request.graph = "dual_rate_accumulation";
  request.graphs = QUELL_TEST_SOURCE "/graphs";
  request.edits = {{Edit::Kind::tap, "history.slow"}, {Edit::Kind::tap, "history.fast"}};
  Wall wall;
  request.roles = wall.roles();
  Diagnostics diagnostics;
  const auto graph = load_graph(request, registry(), diagnostics);
  ASSERT_EQ(diagnostics.format(), "");
  ASSERT_EQ(graph->outputs.size(), 3u);
  Levels levels;
  run_graph(*graph, wall, levels, {});

  // Before the step: means over frames, all of the same light; the fast one is the noisier by far.
  const auto& [dual, slow, fast] =
      std::array{levels.at[kStep - 1][0], levels.at[kStep - 1][1], levels.at[kStep - 1][2]};
  EXPECT_NEAR(dual.mean, 1, 0.01);
  EXPECT_LT(dual.deviation, 0.75 * fast.deviation);
  // Eight frames after it, the fast one has come 1 - (5/6)^9 = 81 % of the way, a slow one on its own 1 - (29/30)^9 =
  // 26 %.
  const auto& then = levels.at[kStep + 8];
  EXPECT_NEAR(then[2].mean, 1 + 2 * 0.81, 0.03);
  EXPECT_GT(then[0].mean, 1 + 2 * 0.65);
  EXPECT_LT(then[0].mean, then[2].mean);
}

}  // namespace
}  // namespace quell::test
