// The graphs that live by history, over the built-in room: each beats its input in every measure.
#include <gtest/gtest.h>

#include "tests/support/paths.h"
#include "tests/support/picture_metrics.h"
#include "tests/support/run_sequence.h"
#include "tests/support/trace_room.h"

namespace quell::test {
namespace {

constexpr int kWidth = 192, kHeight = 108;
constexpr std::int64_t kFrame = 11;

// The last frame and what it is judged by, traced once.
struct Judge {
  std::vector<Image> noisy = trace({kFrame, 1, 0}), noisy_before = trace({kFrame - 1, 1, 0});
  std::vector<Image> a = trace({kFrame, 64, 1001}), b = trace({kFrame, 64, 1002});
  Reference reference{a[0], b[0]};

  double psnr_of(const Image& x) const { return psnr(x, reference); }
  double error_of(const Image& x) const { return relative_error(x, reference); }
  double flicker_of(const Image& x, const Image& before) const {
    return flicker(x, before, noisy[1], noisy[2], noisy_before[2]);
  }

 private:
  struct Take {
    std::int64_t frame;
    int spp, seed;
  };
  static std::vector<Image> trace(Take t) {
    return trace_room({t.frame, t.spp, t.seed, kWidth, kHeight}, {"color", "motion", "id"});
  }
};

struct Gain {
  const char* graph;
  double decibels, error, flicker;  // at least; at most this share of the input's
};
void PrintTo(const Gain& g, std::ostream* out) { *out << g.graph; }

class TemporalGraphs : public testing::TestWithParam<Gain> {};

TEST_P(TemporalGraphs, BeatTheirInput) {
  static const Judge judge;
  const auto result = run_sequence({.graph = GetParam().graph,
                                    .sequence = QUELL_TEST_SOURCE "/graphs/sequences/room.json",
                                    .frames = "0-11",
                                    .source_ints = {{"width", kWidth}, {"height", kHeight}}});
  const Image &now = result.images.at(kFrame)[0], &before = result.images.at(kFrame - 1)[0];
  const Image &noisy = judge.noisy[0], &noisy_before = judge.noisy_before[0];
  const double decibels = judge.psnr_of(now) - judge.psnr_of(noisy);
  const double error = judge.error_of(now) / judge.error_of(noisy);
  const double steadiness = judge.flicker_of(now, before) / judge.flicker_of(noisy, noisy_before);
  RecordProperty("decibels", std::to_string(decibels));
  RecordProperty("relative_error", std::to_string(error));
  RecordProperty("flicker", std::to_string(steadiness));
  EXPECT_GE(decibels, GetParam().decibels);
  EXPECT_LE(error, GetParam().error);
  EXPECT_LE(steadiness, GetParam().flicker);
}

INSTANTIATE_TEST_SUITE_P(Shipped, TemporalGraphs,
                         testing::Values(Gain{"temporal_accumulation", 6, 0.1, 0.2},
                                         Gain{"dual_rate_accumulation", 6, 0.1, 0.2}, Gain{"taa", 1.5, 0.4, 0.2},
                                         Gain{"svgf_falcor", 9, 0.03, 0.2}, Gain{"svgf_dual", 10, 0.02, 0.2}),
                         [](const auto& test) { return std::string(test.param.graph); });

}  // namespace
}  // namespace quell::test
