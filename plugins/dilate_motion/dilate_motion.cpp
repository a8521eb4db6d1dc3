// Lends the motion of moving edges to the pixels beside them, so that what is blended across an edge moves with it.
#include <quell/node.h>

#include <stdexcept>

#include "dilate_motion/dilate_motion_kernels.h"

namespace {

struct DilateMotion {
  quell::In<quell::Motion> motion;
  quell::In<quell::Depth> depth;
  quell::Out<quell::Motion> dilated;
  quell::DilateBy by = quell::DilateBy::length;
  int radius = 1;

  void describe(quell::Describe& d) {
    d.summary("Gives each pixel the motion of the fastest or the nearest pixel around it.");
    d.source("by depth: Karis 2014, High Quality Temporal Supersampling. by length: the anti-aliasing pass of Falcor.");
    d.in(motion, "motion", "Pixels, previous − current.").halo(radius);
    d.in(depth, "depth", "Depth, for by depth.").optional().halo(radius);
    d.out(dilated, "motion",
          "Motion of the chosen pixel; of equals the first, row by row, but the pixel itself first of all.")
        .passes(motion);
    d.param(by, "by", "length: the longest motion of the window. depth: that of the pixel nearest to the camera.",
            {"length", "depth"});
    d.param(radius, "radius", "Half-width of the window, pixels.").range(1, 8);
  }

  void shapes(const quell_spec& spec, quell_shape*) const {
    if (by == quell::DilateBy::depth && !spec.in_count[depth.index])
      throw std::runtime_error("by depth needs 'depth', which is not connected; by length does without");
  }

  void run(const quell::Tile& tile) const {
    const auto& image = tile[motion];
    const quell::MotionField field{{image.plane[0], image.plane[1]},
                                   tile.has(depth) ? tile[depth].plane[0] : nullptr,
                                   image.width,
                                   image.height,
                                   image.pitch};
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* const out[2] = {tile.row(dilated, 0, y), tile.row(dilated, 1, y)};
      quell::dilate_row(field, by, radius, y, tile.x0, tile.x1, out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("dilate_motion", DilateMotion)
