// Darkens an image: a node by the C++ SDK, out of tree.
#include <quell/node.h>

namespace {

struct Darken {
  quell::In<quell::Any> image;
  quell::Out<quell::Any> darker;
  float factor = 0.5f;

  void describe(quell::Describe& d) {
    d.summary("Multiplies every number with a factor.");
    d.in(image, "image", "Any image.");
    d.out(darker, "image", "The image, scaled.").passes(image);
    d.param(factor, "factor", "Factor that each number is multiplied with.").range(0.0, 1.0);
  }

  void run(const quell::Tile& tile) const {
    for (int c = 0; c < tile[image].channels; ++c)
      for (int y = tile.y0; y < tile.y1; ++y) {
        const float* in = tile.row(image, c, y);
        float* out = tile.row(darker, c, y);
        for (int x = tile.x0; x < tile.x1; ++x) out[x] = in[x] * factor;
      }
  }
};

}  // namespace
QUELL_PLUGIN("darken", Darken)
