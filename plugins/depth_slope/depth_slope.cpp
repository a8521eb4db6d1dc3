// How fast depth changes from pixel to pixel on the surface that the pixel shows, so that depth tests can allow for it.
#include <quell/node.h>

#include "depth_slope/depth_slope_kernels.h"

namespace {

struct DepthSlope {
  quell::In<quell::Depth> depth;
  quell::Out<quell::Slope> slope;

  void describe(quell::Describe& d) {
    d.summary(
        "Slope of depth, per pixel: the central difference inside a surface; beside a miss, an edge or a crease the "
        "smaller one-sided one; 0 at a miss.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.4: the gradient in the depth weight.");
    d.in(depth, "depth", "Depth; 1e30 is a miss.").halo(1);
    d.out(slope, "slope", "d depth/dx and d depth/dy, scene units per pixel.");
  }

  void run(const quell::Tile& tile) const {
    const auto& image = tile[depth];
    for (int y = tile.y0; y < tile.y1; ++y)
      quell::slope_row(y > 0 ? tile.row(depth, 0, y - 1) : nullptr, tile.row(depth, 0, y),
                       y + 1 < image.height ? tile.row(depth, 0, y + 1) : nullptr, image.width, tile.x0, tile.x1,
                       tile.row(slope, 0, y), tile.row(slope, 1, y));
  }
};

}  // namespace
QUELL_PLUGIN("depth_slope", DepthSlope)
