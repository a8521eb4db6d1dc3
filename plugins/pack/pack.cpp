// Puts images on top of each other, so that one filter serves them all under one set of weights.
#include <quell/node.h>

#include <algorithm>
#include <stdexcept>

namespace {

struct Pack {
  quell::InList<quell::Any> images;
  quell::Out<quell::Features> packed;

  void describe(quell::Describe& d) {
    d.summary("Joins the channels of several images into one image, which `unpack` takes apart again.");
    d.in(images, "images", "At least one; each of a type of its own, all of one size.");
    d.out(packed, "image", "The channels of the first image, then those of the second, and so on.");
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    if (spec.in_count[images.index] == 0) throw std::runtime_error("'images' is empty: name at least one image");
    out[packed.index].channels = spec.in_channels[images.index];
  }

  void run(const quell::Tile& tile) const {
    const quell_image& to = tile[packed];
    float* const* plane = to.plane;
    for (const quell_image& from : tile[images])
      for (int c = 0; c < from.channels; ++c, ++plane)
        for (int y = tile.y0; y < tile.y1; ++y) {
          const float* row = from.plane[c] + y * from.pitch;
          std::copy(row + tile.x0, row + tile.x1, *plane + y * to.pitch + tile.x0);
        }
  }
};

}  // namespace
QUELL_PLUGIN("pack", Pack)
