// Pulls history into the range of the current frame's neighbourhood, so that what has changed does not linger.
#include <quell/node.h>

#include "outlier_clamp/window.h"

namespace {

struct TemporalClamp {
  quell::In<quell::Any> history;
  quell::In<quell::Any> current;
  quell::Out<quell::Any> clamped;
  int radius = 3;
  float k = 1.0f;

  void describe(quell::Describe& d) {
    d.summary(
        "Clamps reprojected history, channel by channel, into mean ± k·sigma of the current frame around the pixel.");
    d.source("GAMES202 lecture 13 and homework 5, temporal accumulation.");
    d.in(history, "history", "Reprojected history.");
    d.in(current, "current", "This frame, filtered: the statistics of a noisy frame are too wide to catch anything.")
        .halo(radius);
    d.out(clamped, "image", "History within the range.").passes(history);
    d.param(radius, "radius", "Half-width of the neighbourhood, pixels.").range(1, 16);
    d.param(k, "k", "Half-width of the accepted range, standard deviations.").range(0, 1e6);
  }

  void run(const quell::Tile& tile) const {
    const auto& now = tile[current];
    quell::Window window(radius, false, now.width, now.height);
    for (int c = 0; c < now.channels; ++c) {
      const float* plane = now.plane[c];
      for (int y = tile.y0; y < tile.y1; ++y) {
        const auto& stats =
            window.row(y, tile.x0, tile.x1, [&](int u, int v) { return double(plane[v * now.pitch + u]); });
        const float* then = tile.row(history, c, y);
        float* out = tile.row(clamped, c, y);
        for (int x = tile.x0; x < tile.x1; ++x) {
          const auto& s = stats[std::size_t(x - tile.x0)];
          out[x] = quell::clamp_around(then[x], s.mean, k * s.sigma);
        }
      }
    }
  }
};

}  // namespace
QUELL_PLUGIN("temporal_clamp", TemporalClamp)
