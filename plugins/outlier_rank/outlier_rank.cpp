// Replaces a pixel that is brighter or darker than all of its neighbours by one of them.
#include "outlier_rank/outlier_rank_kernels.h"

#include <quell/node.h>

namespace {

struct OutlierRank {
  quell::In<quell::Radiance> image;
  quell::In<quell::Id> id;
  quell::Out<quell::Radiance> selected;
  int radius = 1;
  int rank = 1;

  void describe(quell::Describe& d) {
    d.summary(
        "Replaces a pixel whose luminance lies outside of its neighbours' by the nearest of them, colour and all. "
        "Biased: it takes energy from true highlights too.");
    d.source(
        "Hardie and Boncelet 1993, LUM Filters, as the anti-firefly pass of NVIDIA's ReLAX: rank-conditioned rank "
        "selection");
    d.in(image, "image", "Noisy radiance.").halo(radius);
    d.in(id, "id", "Object numbers: only neighbours of the centre's object count. Without them all do.")
        .optional()
        .halo(radius);
    d.out(selected, "image", "Each pixel is one of its window's; ramps and edges stay as they are.").passes(image);
    d.param(radius, "radius", "Half-width of the window, pixels; the centre itself is left out.").range(1, 3);
    d.param(
         rank, "rank",
         "Which of the neighbours, by luminance, is the limit: 1 is the brightest (and the darkest), 2 the second, so "
         "that two bright pixels beside each other are found as well. Pixels with fewer neighbours stay.")
        .range(1, 4);
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    const quell::RankWindow window{in.plane, tile.has(id) ? tile[id].plane[0] : nullptr, in.pitch, in.width, in.height,
                                   radius};
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* const out[3] = {tile.row(selected, 0, y), tile.row(selected, 1, y), tile.row(selected, 2, y)};
      quell::select_by_rank(window, rank, y, tile.x0, tile.x1, out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("outlier_rank", OutlierRank)
