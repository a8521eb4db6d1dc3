// Dims pixels that are brighter than their neighbours support.
#include "luminance_cap/luminance_cap_kernels.h"

#include <quell/node.h>

#include <algorithm>
#include <vector>

namespace {

enum class Cap : std::int32_t { brightest, mean };

struct LuminanceCap {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Radiance> capped;
  Cap cap = Cap::brightest;
  int radius = 1;
  int rank = 1;
  float margin = 0.0f;

  void describe(quell::Describe& d) {
    d.summary(
        "Caps luminance at the brightest, or at the mean, of the neighbours; RGB is scaled as one. Biased: it takes "
        "energy from true highlights too.");
    d.source("brightest: maximum of a 3×3 neighbourhood; mean: the anti-sparkle filter of Quake II RTX, margin 0.414");
    d.in(image, "image", "Noisy radiance.").halo(radius);
    d.out(capped, "image", "C · min(1, cap / l), with the luminance l = 0.2126 R + 0.7152 G + 0.0722 B.").passes(image);
    d.param(cap, "cap", "What the cap is made of: the rank-th brightest neighbour, or the mean of all.",
            {"brightest", "mean"});
    d.param(radius, "radius", "Half-width of the window, pixels; the centre itself is left out.").range(1, 3);
    d.param(
         rank, "rank",
         "With cap brightest: 1 is the brightest neighbour, 2 the second, so that two bright pixels beside each other "
         "are found as well. Pixels with fewer neighbours stay.")
        .range(1, 4);
    d.param(margin, "margin", "The cap is 1 + margin times that.").range(0.0f, 100.0f);
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    // Luminance of the tile and what its windows reach; vectors read past the last column.
    const int left = std::max(tile.x0 - radius, 0), right = std::min(tile.x1 + radius, in.width);
    const int top = std::max(tile.y0 - radius, 0), bottom = std::min(tile.y1 + radius, in.height);
    const std::ptrdiff_t pitch = (right - left + 15) / 16 * 16 + 32;
    std::vector<float> plane(std::size_t(pitch * (bottom - top)) + 16);
    float* const first = plane.data() + 16;
    for (int y = top; y < bottom; ++y) {
      const float* const rows[3] = {tile.row(image, 0, y), tile.row(image, 1, y), tile.row(image, 2, y)};
      quell::luminances(rows, left, right, first + (y - top) * pitch - left);
    }
    const quell::CapWindow window{first - top * pitch - left,  pitch,     in.width, in.height, radius,
                                  cap == Cap::mean ? 0 : rank, 1 + margin};
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* const from[3] = {tile.row(image, 0, y), tile.row(image, 1, y), tile.row(image, 2, y)};
      float* const to[3] = {tile.row(capped, 0, y), tile.row(capped, 1, y), tile.row(capped, 2, y)};
      quell::cap_luminance(window, y, tile.x0, tile.x1, from, to);
    }
  }
};

}  // namespace
QUELL_PLUGIN("luminance_cap", LuminanceCap)
