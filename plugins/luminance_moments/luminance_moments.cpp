// First and second moment of a pixel's luminance: what temporal variance is accumulated from.
#include <quell/node.h>

#include "luminance_moments/luminance_moments_kernels.h"

namespace {

struct LuminanceMoments {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Moments> moments;

  void describe(quell::Describe& d) {
    d.summary("Luminance and its square, to be accumulated over frames.");
    d.source("Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.2. Luminance by Rec. 709.");
    d.in(image, "image", "Noisy radiance of one frame.");
    d.out(moments, "moments", "l and l² with l = 0.2126 R + 0.7152 G + 0.0722 B.");
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* const rgb[3] = {tile.row(image, 0, y), tile.row(image, 1, y), tile.row(image, 2, y)};
      quell::moments_row(tile.x0, tile.x1, rgb, tile.row(moments, 0, y), tile.row(moments, 1, y));
    }
  }
};

}  // namespace
QUELL_PLUGIN("luminance_moments", LuminanceMoments)
