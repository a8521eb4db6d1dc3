// One level of the edge-avoiding à-trous wavelet transform: a small kernel whose taps lie `step` pixels apart.
#include "atrous/atrous_kernels.h"

#include <quell/node.h>

#include <cstdlib>

namespace {

enum class Kernel : std::int32_t { b3, binomial, box };

struct Atrous {
  quell::In<quell::Any> image;
  quell::In<quell::Variance> variance;
  quell::InList<quell::Weight> weights;
  quell::Out<quell::Any> filtered;
  quell::Out<quell::Variance> filtered_variance;
  int step = 1;
  Kernel kernel = Kernel::b3;

  int radius() const { return kernel == Kernel::b3 ? 2 : 1; }

  void describe(quell::Describe& d) {
    d.summary("Filters by a 5x5 or 3x3 kernel with holes; levels of doubling step make a wide filter.");
    d.source(
        "Dammertz et al. 2010, Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering; "
        "variance "
        "as in Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.3");
    d.in(image, "image", "What is filtered; any number of channels.").halo(radius() * step).step(step);
    d.in(variance, "variance", "Variance of the image's luminance, filtered alongside.")
        .optional()
        .halo(radius() * step)
        .step(step);
    d.in(weights, "weights", "Edge-stopping functions; none leaves the plain kernel.").halo(radius() * step).step(step);
    d.out(filtered, "image", "Σ w c / Σ w over the taps inside the image.").passes(image);
    d.out(filtered_variance, "variance", "Σ w² v / (Σ w)², which takes the taps' noise as independent.")
        .passes(variance)
        .with(variance);
    d.param(step, "step", "Distance between taps, pixels: 1, 2, 4, … for successive levels.").range(1, 64);
    d.param(kernel, "kernel", "b3: (1 4 6 4 1)/16. binomial: (1 2 1)/4. box: (1 1 1)/3; all along x times along y.",
            {"b3", "binomial", "box"});
  }

  double along(int i) const {
    constexpr double kB3[] = {6 / 16.0, 4 / 16.0, 1 / 16.0}, kBinomial[] = {1 / 2.0, 1 / 4.0};
    i = std::abs(i);
    return kernel == Kernel::b3 ? kB3[i] : kernel == Kernel::binomial ? kBinomial[i] : 1 / 3.0;
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    const auto taps =
        quell::square_taps(radius(), step, in.pitch, [this](int dx, int dy) { return along(dx) * along(dy); });
    auto gather = quell::gather_of(taps, tile[weights], in);
    if (tile.has(variance)) gather.variance = tile[variance].plane[0];
    quell::atrous_tile(gather, tile, step, tile[filtered],
                       tile.has(variance) ? tile[filtered_variance].plane[0] : nullptr);
  }
};

}  // namespace
QUELL_PLUGIN("atrous", Atrous)
