// Counts the frames that each pixel's history holds, so that blending can weigh them.
#include <quell/node.h>

#include <algorithm>

#include "history_length/history_length_kernels.h"

namespace {

struct HistoryLength {
  quell::In<quell::Count> before;
  quell::In<quell::Motion> motion;
  quell::In<quell::Taps> taps;
  quell::Out<quell::Count> count;
  int max = 32;

  void describe(quell::Describe& d) {
    d.summary(
        "Frames accumulated, this one included: 1 where the pixel is disoccluded, else one more than its history "
        "held.");
    d.source("Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.1.");
    d.in(before, "before", "This count, one frame earlier.").anywhere();
    d.in(motion, "motion", "Pixels, previous − current.");
    d.in(taps, "taps", "Weights by disocclusion; the count is averaged by them just as reproject averages images.");
    d.out(count, "count", "Frames accumulated, 1 to max; not whole between histories of unlike length.");
    d.param(max, "max", "Where counting ends, frames.").range(1, 65536);
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* out = tile.row(count, 0, y);
      if (tile.missing(before))
        std::fill(out + tile.x0, out + tile.x1, 1.0f);
      else
        quell::count_row(quell::taps_row(tile, motion, taps, tile[before], y), tile.x0, tile.x1, tile.row(before, 0, 0),
                         float(max), out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("history_length", HistoryLength)
