// The next coarser scale of an image.
#include <quell/node.h>

#include <algorithm>

namespace {

struct Halve {
  quell::In<quell::Any> image;
  quell::Out<quell::Any> half;

  void describe(quell::Describe& d) {
    d.summary("Averages blocks of 2×2 pixels to one pixel each, channel by channel.");
    d.source(
        "Wang et al. 2003, Multiscale Structural Similarity: the low-pass filter and downsampling between scales.");
    d.in(image, "image", "Any image of numbers.").anywhere();
    d.out(half, "image", "Half as wide and high, rounded up: the last column or row of an odd size counts twice.");
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    const auto& s = spec.in[image.index];
    out[half.index] = {(s.width + 1) / 2, (s.height + 1) / 2, s.channels};
  }

  void run(const quell::Tile& tile) const {
    const quell_image& from = tile[image];
    for (int c = 0; c < from.channels; ++c)
      for (int y = tile.y0; y < tile.y1; ++y) {
        const float* const top = tile.row(image, c, 2 * y);
        const float* const bottom = tile.row(image, c, std::min(2 * y + 1, from.height - 1));
        float* const out = tile.row(half, c, y);
        for (int x = tile.x0; x < tile.x1; ++x) {
          const int left = 2 * x, right = std::min(left + 1, from.width - 1);
          // Quarters first: sums of the largest floats would not be finite.
          out[x] = (0.25f * top[left] + 0.25f * top[right]) + (0.25f * bottom[left] + 0.25f * bottom[right]);
        }
      }
  }
};

}  // namespace
QUELL_PLUGIN("halve", Halve)
