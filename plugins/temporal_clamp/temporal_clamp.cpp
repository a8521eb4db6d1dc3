// Pulls history into the range of the current frame's neighbourhood, so that what has changed does not linger.
#include <quell/node.h>

#include "temporal_clamp/temporal_clamp_kernels.h"

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
    d.source("GAMES202 homework 5, temporal accumulation.");
    d.in(history, "history", "Reprojected history.");
    d.in(current, "current", "This frame, filtered: the statistics of a noisy frame are too wide to catch anything.")
        .halo(radius);
    d.out(clamped, "image", "History within the range.").passes(history);
    d.param(radius, "radius", "Half-width of the neighbourhood, pixels.").range(1, 16);
    d.param(k, "k", "Half-width of the accepted range, standard deviations.").range(0, 1e6);
  }

  void run(const quell::Tile& tile) const {
    const auto& now = tile[current];
    quell::WindowMemory memory(tile.x1 - tile.x0, radius);
    quell::WindowRange window{nullptr, now.pitch, now.width, now.height, radius, k, false, 0.0f, {}, nullptr, nullptr};
    memory.lend(window);
    for (int c = 0; c < now.channels; ++c) {
      window.plane = now.plane[c];
      for (int y = tile.y0; y < tile.y1; ++y)
        quell::clamp_history(window, y, tile.x0, tile.x1, tile.row(history, c, y), tile.row(clamped, c, y));
    }
  }
};

}  // namespace
QUELL_PLUGIN("temporal_clamp", TemporalClamp)
