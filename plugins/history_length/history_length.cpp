// Counts the frames that each pixel's history holds, so that blending can weigh them.
#include <quell/node.h>

#include <algorithm>

#include "disocclusion/history.h"

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
    d.param(max, "max", "Where counting ends.").range(1, 65536);
  }

  void run(const quell::Tile& tile) const {
    const auto& from = tile[before];
    const bool missing = tile.missing(before);
    quell::each_support(tile, motion, taps, from, [&](int x, int y, const quell::Support& s) {
      float n = 1;
      if (s.size > 0 && !missing) {
        // As differences from the first, so that equal counts stay whole numbers.
        const float first = from.plane[0][s.at[0]];
        float more = 0;
        for (int t = 1; t < s.size; ++t) more += s.weight[t] * (from.plane[0][s.at[t]] - first);
        n = std::clamp(first + more + 1, 1.0f, float(max));
      }
      tile.row(count, 0, y)[x] = n;
    });
  }
};

}  // namespace
QUELL_PLUGIN("history_length", HistoryLength)
