// Fetches history from where each pixel was in the previous frame.
#include <quell/node.h>

#include "reproject/reproject_kernels.h"

namespace {

struct Reproject {
  quell::In<quell::Any> image;
  quell::In<quell::Motion> motion;
  quell::In<quell::Taps> taps;
  quell::Out<quell::Any> warped;
  quell::WarpFilter filter = quell::WarpFilter::bilinear;

  void describe(quell::Describe& d) {
    d.summary("Fetches a previous frame along motion through validated taps; 0 where the pixel is disoccluded.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.1; catmull_rom as in Karis 2014, "
        "High Quality Temporal Supersampling.");
    d.in(image, "image", "An image of the previous frame: a delayed wire.").anywhere();
    d.in(motion, "motion", "Pixels, previous − current.");
    d.in(taps, "taps",
         "Weights by disocclusion. Where all four are 0 but the mask holds valid pixels of the 3×3, their mean is "
         "taken.");
    d.out(warped, "image", "The history of each pixel, at the pixel. Zero motion gives the previous frame to the bit.")
        .passes(image);
    d.param(
        filter, "filter",
        "bilinear: the taps by their weights. nearest: the tap of the largest weight alone, so that values are never "
        "mixed. catmull_rom: the cubic over 4×4 pixels where all of them are valid, held within the range of the "
        "inner four so that it neither rings nor turns negative, and bilinear elsewhere; it keeps detail that "
        "bilinear blurs away frame by frame.",
        {"bilinear", "nearest", "catmull_rom"});
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      quell::warp_row(filter, quell::taps_row(tile, motion, taps, tile[image], y), tile.x0, tile.x1, tile[image],
                      tile[warped]);
  }
};

}  // namespace
QUELL_PLUGIN("reproject", Reproject)
