// What denoisers are known to get wrong, looked for where the truth is known: ghosts behind what moves, blotches after
// a cut, darkness at the border of the image, light lost on what is black. Each measure is shown to see its defect
// where an edit of the graph can put it in.
#include "tests/support/run_shipped.h"
#include "tests/support/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 192, kHeight = 108;

using Edits = std::vector<Edit>;
Edit set(const char* text) { return {Edit::Kind::set, text}; }

struct Difference {
  double bias = 0,
         deviation = 0;  // of result / truth − 1 over the pixels that count: mean, and root of the mean square
  double block = 0;      // the largest mean of 12×12 pixels
};

class Defects : public testing::TestWithParam<std::string> {
 protected:
  // Where `counts`, over the frames from `first` on.
  template <class Counts>
  Difference difference(Stage& stage, Edits edits, std::int64_t first, std::int64_t last, Counts counts) {
    Difference d;
    double number = 0;
    run_shipped(GetParam(), std::move(edits), stage, [&](std::int64_t frame, const FrameOutputs& outputs) {
      if (frame < first || frame > last) return;
      const auto& image = outputs.at("color");
      constexpr int kBlock = 12;
      std::vector<double> sums(kWidth / kBlock * (kHeight / kBlock)), numbers(sums.size());
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (!counts(frame, x, y)) continue;
          const double off = image.plane[1][y * image.pitch + x] / double(stage.truth(frame, x, y)) - 1;
          d.bias += off, d.deviation += off * off, ++number;
          const auto b = std::size_t(y / kBlock * (kWidth / kBlock) + x / kBlock);
          sums[b] += off, ++numbers[b];
        }
      for (std::size_t b = 0; b < sums.size(); ++b)
        if (numbers[b] == kBlock * kBlock) d.block = std::max(d.block, std::abs(sums[b] / numbers[b]));
    });
    d.bias /= number, d.deviation = std::sqrt(d.deviation / number);
    return d;
  }
};

// A bright board before a dim wall, four pixels to the right a frame: the wall that it has uncovered in the last five
// frames.
constexpr int kBoard = 40, kStep = 4, kTop = 30;
int board_left(std::int64_t frame) { return 20 + kStep * int(frame); }
bool on_board(std::int64_t frame, int x, int y) {
  return y >= kTop && y < kTop + kBoard && x >= board_left(frame) && x < board_left(frame) + kBoard;
}
StagePixel board(std::int64_t frame, int x, int y) {
  if (!on_board(frame, x, y)) return {.light = 0.5f};
  return {.light = 6, .depth = 3, .dx = -float(kStep)};
}
bool trail(std::int64_t frame, int x, int y) {
  return !on_board(frame, x, y) && y >= kTop && y < kTop + kBoard && x < board_left(frame) &&
         x >= board_left(frame) - 5 * kStep;
}

TEST_P(Defects, NoGhostBehindWhatMoves) {
  Stage stage(kWidth, kHeight, 16, board);
  const auto good = difference(stage, {}, 8, 15, trail);
  EXPECT_LT(std::abs(good.bias), 0.03);
  EXPECT_LT(good.deviation, 0.06);
  const auto ghost = difference(stage, {set("validity.depth_tolerance=1000000")}, 8, 15, trail);
  EXPECT_GT(ghost.deviation, 0.5) << "a ghost would not be seen";
}

// The same wall before and after, so that no guide tells the shots apart; but the light is another.
StagePixel shots(std::int64_t frame, int x, int y) {
  if (frame < 8) return {.light = (x / 24 + y / 24) % 2 ? 4.0f : 0.2f};
  return {.light = 1};
}
bool everywhere(std::int64_t, int, int) { return true; }

TEST_P(Defects, NoBlotchesAfterACut) {
  Stage declared(kWidth, kHeight, 12, shots, 8), hidden(kWidth, kHeight, 12, shots);
  const auto good = difference(declared, {}, 8, 8, everywhere);
  EXPECT_LT(good.deviation, 0.08);
  EXPECT_LT(good.block, 0.12);
  const auto old_light = difference(hidden, {}, 8, 8, everywhere);
  EXPECT_GT(old_light.block, 0.25) << "light from before the cut would not be seen";
  const auto noise = difference(declared, {set("variance.min_count=1")}, 8, 8, everywhere);
  EXPECT_GT(noise.deviation, 0.16) << "a first frame without variance would not be seen";
}

// The camera pans, so that one side is new in every frame.
StagePixel pan(std::int64_t, int, int) { return {.dx = 1.5f, .dy = -0.75f}; }
bool border(std::int64_t, int x, int y) { return x < 2 || y < 2 || x >= kWidth - 2 || y >= kHeight - 2; }

TEST_P(Defects, NoDarknessAtTheBorder) {
  Stage stage(kWidth, kHeight, 24, pan);
  const auto good = difference(stage, {}, 8, 23, border);
  EXPECT_LT(std::abs(good.bias), 0.03);
}

// Boards of glass, with albedo 0 all of their light is their own, before a wall; one is calm and one is noise.
bool on_glass(std::int64_t, int x, int y) { return y >= 30 && y < 70 && x / 40 % 2 == 1; }
StagePixel glass(std::int64_t frame, int x, int y) {
  if (!on_glass(frame, x, y)) return {};
  return {.albedo = 0, .depth = 3, .noise = x < 80 ? 0.0f : 1.0f};
}

TEST_P(Defects, NoLightIsLostOnBlackAlbedo) {
  Stage stage(kWidth, kHeight, 12, glass);
  const auto calm = difference(stage, {}, 6, 11, [](auto f, int x, int y) { return on_glass(f, x, y) && x < 80; });
  EXPECT_LT(calm.deviation, 0.01);
  const auto noisy = difference(stage, {}, 6, 11, [](auto f, int x, int y) { return on_glass(f, x, y) && x >= 80; });
  // A luminance weight prefers the many dim pixels of such noise, wherever it is.
  EXPECT_LT(std::abs(noisy.bias), 0.06);
  const auto black = difference(stage, {set("demodulation=asymmetric")}, 6, 11, on_glass);
  EXPECT_LT(black.bias, -0.9) << "lost light would not be seen";
}

INSTANTIATE_TEST_SUITE_P(Of, Defects, testing::Values("svgf", "recommended"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quell::test
