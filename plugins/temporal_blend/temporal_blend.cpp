// Mixes the current frame into its reprojected history: an exponential moving average that starts as a plain mean.
#include <quell/node.h>

#include "temporal_blend/temporal_blend_kernels.h"

namespace {

struct TemporalBlend {
  quell::In<quell::Any> current;
  quell::In<quell::Any> history;
  quell::In<quell::Count> count;
  quell::In<quell::Scalar> factor;
  quell::Out<quell::Any> blended;
  float alpha = 0.2f;
  bool warm_up = true;

  void describe(quell::Describe& d) {
    d.summary(
        "current·a + history·(1 − a), with a = max(alpha, 1/count) while it warms up; current alone where count ≤ 1.");
    d.source("Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.1.");
    d.in(current, "current", "This frame.");
    d.in(history, "history", "Reprojected history; not looked at where count ≤ 1.");
    d.in(count, "count", "Frames accumulated, this one included (history_length).");
    d.in(factor, "factor", "What alpha is multiplied by, pixel by pixel, 0 to 1: anti_flicker's.").optional();
    d.out(blended, "image", "The average so far.").passes(current);
    d.param(alpha, "alpha", "Weight of this frame once warmed up: its share of the average.").range(0, 1);
    d.param(warm_up, "warm_up",
            "Give the first frames equal weights, so that the result is their mean until 1/count < alpha.");
  }

  void run(const quell::Tile& tile) const {
    for (int c = 0; c < tile[current].channels; ++c)
      for (int y = tile.y0; y < tile.y1; ++y)
        quell::blend_row({alpha, warm_up}, tile.x0, tile.x1, tile.row(current, c, y), tile.row(history, c, y),
                         tile.row(count, 0, y), tile.has(factor) ? tile.row(factor, 0, y) : nullptr,
                         tile.row(blended, c, y));
  }
};

}  // namespace
QUELL_PLUGIN("temporal_blend", TemporalBlend)
