// Shows motion as a colour wheel.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

struct MotionColor {
  quell::In<quell::Motion> motion;
  quell::Out<quell::Display> display;
  float longest = 16;

  void describe(quell::Describe& d) {
    d.summary("Shows motion as a wheel of colours: hue is direction, brightness is length; black stands still.");
    d.source("Baker et al. 2011, A Database and Evaluation Methodology for Optical Flow: hue for direction.");
    d.in(motion, "motion", "Motion. Above 1e5 pixels there is none to be known, and the pixel is grey.");
    d.out(display, "image", "Colours for an sRGB display: red points right, yellow-green down, cyan left, violet up.");
    d.param(longest, "longest", "Length that gets the full colour, pixels.").range(1e-6, 1e5);
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float dx = tile.row(motion, 0, y)[x], dy = tile.row(motion, 1, y)[x];
        const float length = std::hypot(dx, dy);
        const bool known = length <= 1e5f;
        const float turn = std::atan2(dy, dx) / (2 * std::numbers::pi_v<float>);
        for (int c = 0; c < 3; ++c)
          tile.row(display, c, y)[x] = known ? std::min(length / longest, 1.0f) * hue(turn, c) : 0.5f;
      }
  }

 private:
  // Channel c of the pure hue, `turn` from red over green and blue.
  static float hue(float turn, int c) {
    const float from = turn - float(c) / 3;  // from the peak of the channel
    const float distance = std::abs(from - std::round(from));
    return std::clamp(2 - 6 * distance, 0.0f, 1.0f);
  }
};

}  // namespace
QUELL_PLUGIN("motion_color", MotionColor)
