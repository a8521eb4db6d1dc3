// Blurs any image by a separable kernel.
#include "gaussian/gaussian_kernels.h"

#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

enum class Kernel : std::int32_t { gaussian, binomial, box };

struct Gaussian {
  quell::In<quell::Any> image;
  quell::Out<quell::Any> blurred;
  Kernel kernel = Kernel::gaussian;
  float sigma = 1.0f;
  int radius = 0;

  int reach() const { return kernel == Kernel::gaussian && radius == 0 ? int(std::ceil(3 * double(sigma))) : radius; }

  void describe(quell::Describe& d) {
    d.summary("Blurs by a gaussian, binomial or box kernel, renormalised at the border of the image.");
    d.source(
        "The kernel divided by its part inside the image: Knutsson and Westin 1993, Normalized and Differential "
        "Convolution.");
    d.in(image, "image", "What is blurred; any number of channels.").halo(reach());
    d.out(blurred, "image", "Mean over the pixels of the kernel that lie in the image.").passes(image);
    d.param(kernel, "kernel",
            "gaussian: exp(-d² / 2 sigma²), cut off at the radius. binomial: a row of Pascal's triangle, (1 2 1)/4 for "
            "radius 1. box: flat.",
            {"gaussian", "binomial", "box"});
    d.param(sigma, "sigma", "Standard deviation of the gaussian, pixels.").range(0.1f, 64.0f);
    d.param(radius, "radius",
            "Half-width of the kernel, pixels. 0 is three sigma, rounded up, for the gaussian, and no blur for the "
            "others.")
        .range(0, 192);
  }

  // Weights of distance -radius … radius; sums to 1.
  std::vector<double> weights() const {
    const int r = reach();
    std::vector<double> w(std::size_t(2 * r + 1));
    double choose = 1;  // 2r over i
    for (int i = 0; i <= 2 * r; ++i) {
      const double away = i - r;
      w[std::size_t(i)] = kernel == Kernel::gaussian   ? std::exp(-away * away / (2.0 * sigma * sigma))
                          : kernel == Kernel::binomial ? choose
                                                       : 1;
      choose *= double(2 * r - i) / (i + 1);
    }
    const double sum = std::accumulate(w.begin(), w.end(), 0.0);
    for (double& x : w) x /= sum;
    return w;
  }

  // For positions [begin, end) of `size`: 1 / sum of the weights that fall inside.
  static std::vector<float> shares(const std::vector<double>& w, int begin, int end, int size) {
    const int r = int(w.size() / 2);
    std::vector<float> list;
    for (int at = begin; at < end; ++at) {
      const int first = std::max(0, r - at), last = std::min(2 * r, size - 1 - at + r);
      list.push_back(float(1 / std::accumulate(w.begin() + first, w.begin() + last + 1, 0.0)));
    }
    return list;
  }

  void run(const quell::Tile& tile) const {
    const auto w = weights();
    const quell_image& in = tile[image];
    quell::Blur blur{reach(),
                     {w.begin(), w.end()},
                     shares(w, tile.x0, tile.x1, in.width),
                     shares(w, tile.y0, tile.y1, in.height),
                     std::vector<float>(std::size_t(tile.x1 - tile.x0 + 2 * reach() + quell::Blur::kPad))};
    blur.across.resize(blur.across.size() + quell::Blur::kPad);
    quell::gaussian_tile(blur, tile, in, tile[blurred]);
  }
};

}  // namespace
QUELL_PLUGIN("gaussian", Gaussian)
