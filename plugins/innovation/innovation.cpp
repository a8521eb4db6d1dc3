// Tells noise in a feature from texture: single pixels that neither their neighbours nor the previous frame foretell.
#include <quell/node.h>

#include <algorithm>
#include <vector>

#include "innovation/innovation_kernels.h"

namespace {

struct Innovation {
  quell::In<quell::Any> image;
  quell::In<quell::Any> before;
  quell::In<quell::Motion> motion;
  quell::In<quell::Taps> taps;
  quell::Out<quell::Scalar> innovation;
  float tolerance = 0.1f;
  float share = 0.02f;

  void describe(quell::Describe& d) {
    d.summary(
        "Marks single pixels of a feature that are unlike all around them and unlike all of the previous frame where "
        "they come from: dither, not texture. Averaged over time and space it says where a feature is noise.");
    d.source(
        "Our own. A pixel is marked where in some channel it lies more than the tolerance outside the range of its "
        "eight neighbours, and in some channel outside that of the 4×4 around its place in the previous frame. A "
        "texture, however sharp, was there a frame ago; a surface that turns bright does so together.");
    d.in(image, "image", "This frame's feature, albedo for one.").halo(1);
    d.in(before, "before", "The same, one frame earlier: a delayed wire.").anywhere();
    d.in(motion, "motion", "Pixels, previous − current.");
    d.in(taps, "taps", "By disocclusion: only where the whole 4×4 is valid is a pixel marked.");
    d.out(innovation, "innovation", "1 / share where a pixel is marked, else 0; 0 at the image's border.");
    d.param(tolerance, "tolerance", "Distance that is none, in units of the feature.").range(0, 1e6);
    d.param(share, "share", "Share of marked pixels whose average is to be 1.").range(1e-4, 1);
  }

  void run(const quell::Tile& tile) const {
    const auto &now = tile[image], &past = tile[before];
    const int from = std::max(tile.x0 - 1, 0), to = std::min(tile.x1 + 1, now.width);
    const std::ptrdiff_t length = tile.x1 - tile.x0 + 2 + 16;  // vectors read past the last pixel
    std::vector<float> memory(std::size_t(3 * now.channels * length));
    std::vector<const float*> around(std::size_t(3 * now.channels));
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* out = tile.row(innovation, 0, y);
      if (tile.missing(before)) {
        std::fill(out + tile.x0, out + tile.x1, 0.0f);
        continue;
      }
      for (std::size_t i = 0; i < around.size(); ++i) {
        const float* row = now.plane[i / 3] + std::clamp(y + int(i % 3) - 1, 0, now.height - 1) * now.pitch;
        float* copy = memory.data() + std::ptrdiff_t(i) * length - (tile.x0 - 1);
        std::copy(row + from, row + to, copy + from);
        copy[tile.x0 - 1] = row[from];
        copy[tile.x1] = row[to - 1];
        around[i] = copy;
      }
      quell::innovation_row({quell::taps_row(tile, motion, taps, past, y), past, around.data(), tolerance, share},
                            tile.x0, tile.x1, out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("innovation", Innovation)
