// Measures how much of a frame shows what the previous one did not: nearly all of it after a cut.
#include <quell/node.h>

#include "disoccluded_share/disoccluded_share_kernels.h"

namespace {

struct DisoccludedShare {
  quell::In<quell::Taps> taps;
  quell::Out<quell::Value> share;

  void describe(quell::Describe& d) {
    d.summary("Gives the share of a frame's pixels that have no valid tap: one number a frame, for cut_gate.");
    d.source("Quell: a cut shows as disocclusion everywhere, whatever the renderer.");
    d.in(taps, "taps", "Weights and masks by disocclusion.").anywhere();
    d.out(share, "share", "Pixels whose mask is empty / pixels, 0 to 1; 1 where history is missing.");
  }

  void shapes(const quell_spec&, quell_shape* out) const { out[share.index] = {1, 1, 1}; }

  void run(const quell::Tile& tile) const {
    const auto& image = tile[taps];
    // Whole numbers, so the order in which they are summed is of no consequence.
    std::int64_t count = 0;
    for (int y = 0; y < image.height; ++y)
      count += quell::count_disoccluded(tile.bits(taps, quell::kTapsMask, y), image.width);
    *tile.row(share, 0, 0) = float(double(count) / (double(image.width) * image.height));
  }
};

}  // namespace
QUELL_PLUGIN("disoccluded_share", DisoccludedShare)
