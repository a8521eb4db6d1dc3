// Fills what has just come into view from far around, before finer filters see it.
#include "history_fix/history_fix_kernels.h"

#include <quell/node.h>

#include <cmath>

namespace {

struct HistoryFix {
  quell::In<quell::Any> image;
  quell::In<quell::Count> count;
  quell::InList<quell::Weight> weights;
  quell::Out<quell::Any> fixed;
  int frames = 3;
  float stride = 14.0f;

  // Of the youngest pixels, whose taps lie farthest apart.
  int longest() const { return quell::fix_stride(stride, 1.0f); }

  void describe(quell::Describe& d) {
    d.summary(
        "Averages pixels with little history over 5×5 taps, the farther apart the younger the pixel; others pass.");
    d.source("ReLAX, history fix (NVIDIA Real-Time Denoisers 4).");
    d.in(image, "image", "Accumulated image; any number of channels.").halo(2 * longest());
    d.in(count, "count", "Frames accumulated, this one included (history_length).");
    d.in(weights, "weights",
         "Edge-stopping functions of the guides (normal, plane or depth), for the taps lie far apart; none averages "
         "all "
         "of them.")
        .halo(2 * longest());
    d.out(fixed, "image",
          "Σ w c / Σ w over the taps inside the image where count ≤ frames; elsewhere the image, to the bit.")
        .passes(image);
    d.param(frames, "frames", "Largest count that is still fixed, frames.").range(0, 8);
    d.param(stride, "stride",
            "Pixels from tap to tap are stride / (1 + count), rounded, and 1 at least: 7, 5 and 4 for the first three "
            "frames.")
        .range(1, 64);
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    quell::HistoryFix fix{in, tile[weights], tile[count].plane[0], float(frames), stride, {}};
    for (int s = 0; s <= longest(); ++s)
      fix.taps.push_back(quell::square_taps(2, s, in.pitch, [](int, int) { return 1.0; }));
    quell::fix_tile(fix, tile, tile[fixed]);
  }
};

}  // namespace
QUELL_PLUGIN("history_fix", HistoryFix)
