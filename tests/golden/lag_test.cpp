// The metrics lag and lagging on sequences whose lag is known.
#include "tests/support/judge.h"
#include "tests/support/run_node.h"

#include <quell/types.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace quell::test {
namespace {

constexpr int kWidth = 48, kHeight = 40, kStepAt = 2;

// A textured wall on which a lamp goes on, seen by a camera that moves by (dx, dy) pixels a frame; and an exponential
// average over frames of what was seen, with noise of its own.
struct Film {
  int frames = 36;
  double alpha = 0.2, noise = 0, before = 1, after = 4;
  int dx = 0, dy = 0;

  Image reference(int frame) const { return at(frame, frame < kStepAt ? before : after); }
  Image image(int frame) const {
    double light = before;
    for (int f = kStepAt; f <= frame; ++f) light += alpha * (after - light);
    auto seen = at(frame, light);
    const double size = noise * std::abs(after - before);
    const auto grain = noise_image(kWidth, kHeight, 3, std::uint32_t(100 + frame), float(-size), float(size));
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) seen.at(c, x, y) += grain.at(c, x, y);
    return seen;
  }
  std::vector<Verdict> judged_by(const std::string& metric, std::vector<Edit> edits = {}) const {
    std::vector<Image> images, references;
    for (int f = 0; f < frames; ++f) images.push_back(image(f)), references.push_back(reference(f));
    auto motion = constant_image(kWidth, kHeight, 2, float(dx));
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) motion.at(1, x, y) = float(dy);
    std::vector<JudgedFrame> list;
    for (std::size_t f = 0; f < images.size(); ++f)
      list.push_back({{"image", {QUELL_RADIANCE, &images[f]}},
                      {"reference", {QUELL_RADIANCE, &references[f]}},
                      {"motion", {QUELL_MOTION, &motion}}});
    return judge(metric, list, std::move(edits));
  }

 private:
  Image at(int frame, double light) const {
    static const auto wall = noise_image(kWidth + 60, kHeight + 60, 3, 5, 0.5f, 1);
    Image seen(kWidth, kHeight, 3);
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          seen.at(c, x, y) = float(light * wall.at(c, x + 20 + dx * frame, y + 20 + dy * frame));
    return seen;
  }
};

// The least n with (1 - alpha)^(n + 1) < 0.1, for the frame of the step has seen alpha of it already.
int exact(double alpha) {
  int n = 0;
  for (double left = 1 - alpha; left >= 0.1; left *= 1 - alpha) ++n;
  return n;
}

TEST(Lag, OfAnExponentialAverageIsThatOfItsAlpha) {
  EXPECT_EQ(exact(0.1), 21);
  EXPECT_EQ(exact(0.2), 10);
  for (const double after : {4.0, 0.25})
    for (const double alpha : {0.1, 0.2, 0.5, 1.0}) {
      Film film;
      film.alpha = alpha, film.after = after;
      const auto lag = film.judged_by("lag"), lagging = film.judged_by("lagging");
      double sum = 0;
      for (int f = 0; f < film.frames; ++f) {
        const bool last = f == kStepAt + 31, follows = f >= kStepAt && f <= kStepAt + 31;
        EXPECT_EQ(lag[std::size_t(f)].pixels, last ? kWidth * kHeight : 0) << f;
        EXPECT_EQ(lagging[std::size_t(f)].pixels, follows ? kWidth * kHeight : 0) << f;
        if (follows) sum += lagging[std::size_t(f)].value;
      }
      EXPECT_EQ(lag[kStepAt + 31].value, exact(alpha)) << alpha << " to " << after;
      EXPECT_EQ(sum, exact(alpha)) << "frames that lag, counted one by one";
      EXPECT_EQ(lag[kStepAt + 5].map.at(0, 7, 7), std::min(exact(alpha), 6)) << "so far";
    }
}

TEST(Lag, EndsWithItsWindow) {
  Film film;
  film.alpha = 0.01;
  EXPECT_EQ(film.judged_by("lag")[kStepAt + 31].value, 32) << "not reached";
  film.frames = 12;
  film.alpha = 0.5;
  const auto short_window = film.judged_by("lag", {{Edit::Kind::set, "window=6"}});
  EXPECT_EQ(short_window[kStepAt + 5].value, exact(0.5));
  EXPECT_EQ(short_window[kStepAt + 5].pixels, kWidth * kHeight);
}

// What the camera loses from sight does not count, nor what comes into it.
TEST(Lag, MovesWithThePicture) {
  Film film;
  film.frames = 12, film.alpha = 0.5, film.dx = 3, film.dy = -1;
  const auto verdict = std::move(film.judged_by("lag", {{Edit::Kind::set, "window=6"}})[kStepAt + 5]);
  EXPECT_EQ(verdict.value, exact(0.5));
  EXPECT_EQ(verdict.pixels, (kWidth - 6 * 3) * (kHeight - 6));
}

// Noise of a fifth of the step: single pixels reach it by chance, means of 7×7 hardly.
TEST(Lag, HardlyMindsNoise) {
  Film film;
  film.noise = 0.2;
  const double by_windows = film.judged_by("lag")[kStepAt + 31].value,
               by_pixels = film.judged_by("lag", {{Edit::Kind::set, "radius=0"}})[kStepAt + 31].value;
  EXPECT_NEAR(by_windows, exact(0.2), 1);
  EXPECT_LT(by_pixels, exact(0.2) - 2);
}

TEST(Lag, IsOfStepsOfLightAlone) {
  Film steady;
  steady.after = steady.before;
  Film small;
  small.after = 1.3;  // 1 is 0.77 of it
  for (const Film& film : {steady, small})
    for (const auto& verdict : film.judged_by("lagging")) EXPECT_EQ(verdict.pixels, 0);
  Film enough;
  enough.after = 1.4;
  EXPECT_GT(enough.judged_by("lagging")[kStepAt].pixels, 0);
}

// A reference that is noise alone steps everywhere, up and down.
TEST(Lag, IsNotOfANoisyReference) {
  std::vector<Image> noise;
  for (std::uint32_t f = 0; f < 4; ++f) noise.push_back(noise_image(kWidth, kHeight, 3, 7 + f));
  const auto motion = constant_image(kWidth, kHeight, 2, 0);
  std::vector<JudgedFrame> frames;
  for (const auto& image : noise)
    frames.push_back({{"image", {QUELL_RADIANCE, &image}},
                      {"reference", {QUELL_RADIANCE, &image}},
                      {"motion", {QUELL_MOTION, &motion}}});
  for (const auto& verdict : judge("lagging", frames, {{Edit::Kind::set, "radius=0"}})) EXPECT_EQ(verdict.pixels, 0);
  EXPECT_GT(judge("lagging", frames, {{Edit::Kind::set, "radius=0"}, {Edit::Kind::set, "least=0"}}).back().pixels,
            kWidth * kHeight / 2);
}

}  // namespace
}  // namespace quell::test
