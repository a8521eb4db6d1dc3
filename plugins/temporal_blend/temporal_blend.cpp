// Mixes the current frame into its reprojected history: an exponential moving average that starts as a plain mean.
#include <quell/node.h>

#include <algorithm>

namespace {

struct TemporalBlend {
  quell::In<quell::Any> current;
  quell::In<quell::Any> history;
  quell::In<quell::Count> count;
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
    d.out(blended, "image", "The average so far.").passes(current);
    d.param(alpha, "alpha", "Weight of this frame once warmed up.").range(0, 1);
    d.param(warm_up, "warm_up",
            "Give the first frames equal weights, so that the result is their mean until 1/count < alpha.");
  }

  void run(const quell::Tile& tile) const {
    const int channels = tile[current].channels;
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* n = tile.row(count, 0, y);
      for (int c = 0; c < channels; ++c) {
        const float* now = tile.row(current, c, y);
        const float* then = tile.row(history, c, y);
        float* out = tile.row(blended, c, y);
        for (int x = tile.x0; x < tile.x1; ++x) {
          const float a = warm_up ? std::max(alpha, 1.0f / std::max(n[x], 1.0f)) : alpha;
          // As a step away from history, so that equal frames stay what they are to the bit.
          out[x] = n[x] > 1 && a < 1 ? then[x] + a * (now[x] - then[x]) : now[x];
        }
      }
    }
  }
};

}  // namespace
QUELL_PLUGIN("temporal_blend", TemporalBlend)
