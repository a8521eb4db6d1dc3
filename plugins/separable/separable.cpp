// A weighted mean along a row or a column: two of them in a row make a wide filter of few taps.
#include "separable/separable_kernels.h"

#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace {

enum class Direction : std::int32_t { horizontal, vertical };
enum class Kernel : std::int32_t { gaussian, flat };

constexpr int kMaxRadius = 64;

struct Separable {
  quell::In<quell::Any> image;
  quell::InList<quell::Weight> weights;
  quell::Out<quell::Any> filtered;
  Direction direction = Direction::horizontal;
  int radius = 0;
  Kernel kernel = Kernel::gaussian;
  float sigma = 4.0f;

  int reach() const { return radius ? radius : int(std::min(std::ceil(3 * double(sigma)), double(kMaxRadius))); }

  void describe(quell::Describe& d) {
    const int x = direction == Direction::horizontal ? reach() : 0, y = reach() - x;
    d.summary(
        "Averages the pixels of a row or column about each pixel, as the kernel and the weight nodes will have it. A "
        "horizontal and a vertical pass are a two-dimensional filter: exactly without weights, nearly with them.");
    d.source(
        "Pham and van Vliet 2005, Separable Bilateral Filtering for Fast Video Preprocessing. The weights of both "
        "passes should compare the same images, not the first pass' result.");
    d.in(image, "image", "What is filtered; any number of channels.").halo(x, y);
    d.in(weights, "weights", "Edge-stopping functions; none leaves the plain kernel.").halo(x, y);
    d.out(filtered, "image", "Σ w c / Σ w over the pixels of the pass that lie in the image; the centre counts fully.")
        .passes(image);
    d.param(direction, "direction", "Along rows or along columns.", {"horizontal", "vertical"});
    d.param(radius, "radius",
            "Half-width of the pass, pixels: 2 radius + 1 taps. 0 is three sigma, rounded up, and at most 64.")
        .range(0, kMaxRadius);
    d.param(kernel, "kernel", "gaussian: exp(-d² / 2 sigma²). flat: 1, the box filter.", {"gaussian", "flat"});
    d.param(sigma, "sigma", "Standard deviation of the gaussian, pixels; sets the width where radius is 0.")
        .range(0.1f, 1000.0f);
  }

  double weight(int distance) const {
    return kernel == Kernel::flat ? 1.0 : std::exp(-distance * distance / (2.0 * sigma * sigma));
  }

  void run(const quell::Tile& tile) const { tile[weights].empty() ? convolve(tile) : gather(tile); }

  void gather(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    quell::TapSet taps;
    for (int d = 1; d <= reach(); ++d)
      direction == Direction::horizontal ? taps.add_pair(d, 0, weight(d), in.pitch)
                                         : taps.add_pair(0, d, weight(d), in.pitch);
    quell::separable_tile(quell::gather_of(taps, tile[weights], in), tile, tile[filtered]);
  }

  void convolve(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    const int r = reach();
    std::vector<double> w;
    for (int d = -r; d <= r; ++d) w.push_back(weight(d));
    quell::Convolution c{r, {w.begin(), w.end()}, {}};
    const bool along_x = direction == Direction::horizontal;
    const int begin = along_x ? tile.x0 : tile.y0, end = along_x ? tile.x1 : tile.y1,
              size = along_x ? in.width : in.height;
    for (int at = begin; at < end; ++at) {
      const int first = std::max(0, r - at), last = std::min(2 * r, size - 1 - at + r);
      c.inverse.push_back(float(1 / std::accumulate(w.begin() + first, w.begin() + last + 1, 0.0)));
    }
    c.inverse.resize(c.inverse.size() + quell::Convolution::kPad);
    along_x ? quell::convolve_rows(c, tile, in, tile[filtered]) : quell::convolve_columns(c, tile, in, tile[filtered]);
  }
};

}  // namespace
QUELL_PLUGIN("separable", Separable)
