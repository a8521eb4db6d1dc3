// Picture quality of SVGF and of the recommended graph on a path-traced room with references, scored so that the
// references' own noise cancels: PSNR* = -10 log10 mean((T(X) - T(A)) (T(X) - T(B))), T(x) = x / (1 + x), A and B
// independent references; flicker = mean |T(X_t) - warp T(X_{t-1})| over pixels with four valid taps of the same
// object, times 1000.
#include "tests/support/paths.h"
#include "tests/support/run_sequence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

constexpr int kLast = 16;

double tone(float x) { return double(x) / (1.0 + double(x)); }

std::string numbered(const std::string& head, int frame, const std::string& tail) {
  const auto n = std::to_string(frame);
  return head + std::string(4 - n.size(), '0') + n + tail;
}

double psnr(const Image& x, const Image& a, const Image& b) {
  double sum = 0;
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < x.height(); ++y)
      for (int u = 0; u < x.width(); ++u)
        sum += (tone(x.at(c, u, y)) - tone(a.at(c, u, y))) * (tone(x.at(c, u, y)) - tone(b.at(c, u, y)));
  return -10 * std::log10(sum / (3.0 * x.width() * x.height()));
}

double flicker(const SequenceResult& r, const std::string& folder, int first) {
  double total = 0;
  Image ids_before;
  for (int f = first; f <= kLast; ++f) {
    const auto file = numbered(folder + "/spp1/frame_", f, ".exr");
    const Image motion = read_channels(file, {"motion.X", "motion.Y"});
    Image ids = read_channels(file, {"objectId"});
    if (f > first) {
      const Image &now = r.images.at(f)[0], &before = r.images.at(f - 1)[0];
      double sum = 0;
      long count = 0;
      for (int y = 0; y < now.height(); ++y)
        for (int x = 0; x < now.width(); ++x) {
          const double sx = x + double(motion.at(0, x, y)), sy = y + double(motion.at(1, x, y));
          const int bx = int(std::floor(sx)), by = int(std::floor(sy));
          if (bx < 0 || by < 0 || bx + 1 >= now.width() || by + 1 >= now.height()) continue;
          const double fx = sx - bx, fy = sy - by, w[4] = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
          bool valid = true;
          for (int k = 0; k < 4; ++k) valid = valid && ids_before.at(0, bx + k % 2, by + k / 2) == ids.at(0, x, y);
          if (!valid) continue;
          for (int c = 0; c < 3; ++c) {
            double warped = 0;
            for (int k = 0; k < 4; ++k) warped += w[k] * tone(before.at(c, bx + k % 2, by + k / 2));
            sum += std::abs(tone(now.at(c, x, y)) - warped);
          }
          count += 3;
        }
      total += 1000 * sum / double(count);
    }
    ids_before = std::move(ids);
  }
  return total / (kLast - first);
}

struct Score {
  double psnr = 0, flicker = 0, late_flicker = 0;
};

Score score(const std::string& graph, const std::vector<Edit>& edits) {
  const std::string folder = test_data() + "/cycles-cornell";
  const auto result = run_sequence({.graph = graph,
                                    .sequence = QUELL_TEST_SOURCE "/tests/data_sequences/cycles-cornell.json",
                                    .root = folder,
                                    .edits = edits});
  Score s;
  for (const int f : {4, 8, 15, 16}) {
    const auto a = read_channels(numbered(folder + "/reference/frame_", f, "_A.exr"), {"R", "G", "B"});
    const auto b = read_channels(numbered(folder + "/reference/frame_", f, "_B.exr"), {"R", "G", "B"});
    s.psnr += psnr(result.images.at(f)[0], a, b) / 4;
  }
  s.flicker = flicker(result, folder, 1);
  s.late_flicker = flicker(result, folder, 8);
  return s;
}

TEST(CyclesCornell, DefaultsReachTheirQuality) {
  if (test_data().empty()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  const auto s = score("svgf", {});
  RecordProperty("psnr", std::to_string(s.psnr));
  RecordProperty("flicker", std::to_string(s.flicker));
  EXPECT_GE(s.psnr, 40.5);
  EXPECT_LE(s.flicker, 1.5);
}

// The paper's own parameters and the demodulation that is usual: what svgf.json departs from.
TEST(CyclesCornell, ThePapersParametersReachTheirQuality) {
  if (test_data().empty()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  using enum Edit::Kind;
  const auto s =
      score("svgf", {{set, "demodulation=classic"}, {set, "emitters=keep"}, {set, "alpha=0.2"}, {set, "min_count=4"}});
  RecordProperty("psnr", std::to_string(s.psnr));
  RecordProperty("flicker", std::to_string(s.flicker));
  EXPECT_GE(s.psnr, 37.0);
  EXPECT_LE(s.late_flicker, 1.5);  // of frames 9 to 16, once the room is accumulated
}

TEST(CyclesCornell, RecommendedReachesItsQuality) {
  if (test_data().empty()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  const auto s = score("recommended", {});
  RecordProperty("psnr", std::to_string(s.psnr));
  RecordProperty("flicker", std::to_string(s.flicker));
  EXPECT_GE(s.psnr, 42.8);
  EXPECT_LE(s.flicker, 1.3);
}

}  // namespace
}  // namespace quell::test
