// Goes from one image to another, pixel by pixel.
#include <quell/node.h>

#include "mix/mix_kernels.h"

namespace {

struct Mix {
  quell::In<quell::Any> image;
  quell::In<quell::Any> other;
  quell::In<quell::Scalar> share;
  quell::Out<quell::Any> mixed;

  void describe(quell::Describe& d) {
    d.summary("image·(1 − s) + other·s, with the share s of each pixel held to [0, 1].");
    d.source("Linear interpolation. To replace a feature where it is noise, and nowhere else: share by innovation.");
    d.in(image, "image", "Where the share is 0, this to the bit.");
    d.in(other, "other", "Where the share is 1, this, up to rounding.");
    d.in(share, "share", "How much of the other, 0 to 1.");
    d.out(mixed, "image", "The mixture.").passes(image);
  }

  void run(const quell::Tile& tile) const {
    for (int c = 0; c < tile[image].channels; ++c)
      for (int y = tile.y0; y < tile.y1; ++y)
        quell::mix_row(tile.x0, tile.x1, tile.row(image, c, y), tile.row(other, c, y), tile.row(share, 0, y),
                       tile.row(mixed, c, y));
  }
};

}  // namespace
QUELL_PLUGIN("mix", Mix)
