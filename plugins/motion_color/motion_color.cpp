// Shows motion as a colour wheel.
#include <quell/node.h>

#include "motion_color/motion_color_kernels.h"

namespace {

struct MotionColor {
  quell::In<quell::Motion> motion;
  quell::Out<quell::Display> display;
  float longest = 16;

  void describe(quell::Describe& d) {
    d.summary("Shows motion as a wheel of colours: hue is direction, brightness is length; black stands still.");
    d.source(
        "After Baker et al. 2011, A Database and Evaluation Methodology for Optical Flow: hue for direction. Channel c "
        "is "
        "½ + cos(angle − c · 120°), clamped to [0,1], times length / longest.");
    d.in(motion, "motion", "Motion. Above 1e5 pixels there is none to be known, and the pixel is grey.");
    d.out(display, "image", "Colours for an sRGB display: red points right, yellow-green down, cyan left, violet up.");
    d.param(longest, "longest", "Length that gets the full colour, pixels.").range(1e-6, 1e5);
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* const out[3] = {tile.row(display, 0, y), tile.row(display, 1, y), tile.row(display, 2, y)};
      quell::motion_color_row(longest, tile.x0, tile.x1, tile.row(motion, 0, y), tile.row(motion, 1, y), out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("motion_color", MotionColor)
