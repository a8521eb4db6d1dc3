// A weighted mean over a whole window: with weight nodes the bilateral and the joint bilateral filter.
#include "window/window_kernels.h"

#include <quell/node.h>

#include <cmath>

namespace {

enum class Kernel : std::int32_t { gaussian, flat };
enum class Shape : std::int32_t { square, disc };

struct Window {
  quell::In<quell::Any> image;
  quell::InList<quell::Weight> weights;
  quell::Out<quell::Any> filtered;
  int radius = 8;
  Shape shape = Shape::square;
  Kernel kernel = Kernel::gaussian;
  float sigma = 4.0f;

  void describe(quell::Describe& d) {
    d.summary("Averages all pixels of a window, each as the kernel and the weight nodes will have it.");
    d.source(
        "Petschnigg et al. 2004, Digital Photography with Flash and No-Flash Image Pairs, section 4.1 (joint "
        "bilateral)");
    d.in(image, "image", "What is filtered; any number of channels.").halo(radius);
    d.in(weights, "weights", "Edge-stopping functions; none leaves the plain kernel.").halo(radius);
    d.out(filtered, "image",
          "Σ w c / Σ w over the pixels of the window that lie in the image; the centre counts fully.")
        .passes(image);
    d.param(radius, "radius", "Half-width of the window, pixels: (2 radius + 1)² taps.").range(1, 32);
    d.param(
        shape, "shape",
        "square: the whole window. disc: dx² + dy² <= radius², which is alike in all directions and has a fifth to a "
        "third fewer taps.",
        {"square", "disc"});
    d.param(kernel, "kernel", "gaussian: exp(-(dx² + dy²) / 2 sigma²). flat: 1, the box filter.", {"gaussian", "flat"});
    d.param(sigma, "sigma", "Standard deviation of the gaussian, pixels.").range(0.1f, 1000.0f);
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    const auto taps = quell::square_taps(radius, 1, in.pitch, [this](int dx, int dy) {
      if (shape == Shape::disc && dx * dx + dy * dy > radius * radius) return 0.0;
      return kernel == Kernel::flat ? 1.0 : std::exp(-(dx * dx + dy * dy) / (2.0 * sigma * sigma));
    });
    quell::window_tile(quell::gather_of(taps, tile[weights], in), tile, tile[filtered]);
  }
};

}  // namespace
QUELL_PLUGIN("window", Window)
