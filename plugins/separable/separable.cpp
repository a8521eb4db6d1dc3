// A weighted mean along a row or a column: two of them in a row make a wide filter of few taps.
#include "separable/separable_kernels.h"

#include <quell/node.h>

#include <algorithm>
#include <cmath>

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
    d.param(kernel, "kernel", "gaussian: exp(-d² / 2 sigma²). flat: 1.", {"gaussian", "flat"});
    d.param(sigma, "sigma", "Standard deviation of the gaussian, pixels; sets the width where radius is 0.")
        .range(0.1f, 1000.0f);
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    quell::TapSet taps;
    for (int d = 1; d <= reach(); ++d) {
      const double k = kernel == Kernel::flat ? 1.0 : std::exp(-d * d / (2.0 * sigma * sigma));
      direction == Direction::horizontal ? taps.add_pair(d, 0, k, in.pitch) : taps.add_pair(0, d, k, in.pitch);
    }
    quell::separable_tile(quell::gather_of(taps, tile[weights], in), tile, tile[filtered]);
  }
};

}  // namespace
QUELL_PLUGIN("separable", Separable)
