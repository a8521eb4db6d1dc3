// Drops all history on a cut that the sequence does not declare.
#include <quell/node.h>

#include <algorithm>

namespace {

struct CutGate {
  quell::In<quell::Taps> taps;
  quell::In<quell::Value> share;
  quell::Out<quell::Taps> gated;
  float threshold = 0.5f;

  void describe(quell::Describe& d) {
    d.summary(
        "Lets taps through, or none of the whole frame where too much of it is disoccluded: what little history a cut "
        "leaves valid is valid by accident.");
    d.source("Quell: a cut shows as disocclusion everywhere, whatever the renderer.");
    d.in(taps, "taps", "Weights and masks by disocclusion.");
    d.in(share, "share", "Share of the frame that is disoccluded (disoccluded_share).");
    d.out(gated, "taps",
          "The taps, or 0 throughout where share > threshold: every node that they gate starts anew, as after a cut "
          "that the sequence declares.")
        .passes(taps);
    d.param(threshold, "threshold", "Largest share of disoccluded pixels that is still one shot.").range(0, 1);
  }

  void run(const quell::Tile& tile) const {
    const bool cut = *tile.row(share, 0, 0) > threshold;
    for (int plane = 0; plane < 5; ++plane)
      for (int y = tile.y0; y < tile.y1; ++y) {
        float* const to = tile.row(gated, plane, y);
        if (cut)
          std::fill(to + tile.x0, to + tile.x1, 0.0f);
        else  // as they are: the mask is no number
          std::copy(tile.bits(taps, plane, y) + tile.x0, tile.bits(taps, plane, y) + tile.x1,
                    tile.bits(gated, plane, y) + tile.x0);
      }
  }
};

}  // namespace
QUELL_PLUGIN("cut_gate", CutGate)
