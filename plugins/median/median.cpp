// The median of a square window: a filter that a few outliers cannot move.
#include "median/median_kernels.h"

#include <quell/node.h>

namespace {

struct Median {
  quell::In<quell::Any> image;
  quell::Out<quell::Any> filtered;
  int radius = 1;

  void describe(quell::Describe& d) {
    d.summary("Replaces each value by the median of its window, channel by channel.");
    d.source(
        "Tukey 1977, Exploratory Data Analysis; the selection: Paeth 1990, Graphics Gems, Median Finding on a 3×3 "
        "Grid");
    d.in(image, "image", "What is filtered; any number of channels, which may shift hue.").halo(radius);
    d.out(filtered, "image",
          "The middle one of the values of the window that lie in the image, the lower one where there are two.")
        .passes(image);
    d.param(radius, "radius", "Half-width of the window, pixels.").range(1, 3);
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    for (int c = 0; c < in.channels; ++c) {
      const quell::MedianWindow window{in.plane[c], in.pitch, in.width, in.height, radius};
      for (int y = tile.y0; y < tile.y1; ++y)
        quell::median_row(window, y, tile.x0, tile.x1, tile[filtered].plane[c] + y * tile[filtered].pitch);
    }
  }
};

}  // namespace
QUELL_PLUGIN("median", Median)
