// Structural similarity: whether two images have their structures in common.
#include <quell/node.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "ssim/ssim_kernels.h"

namespace {

using quell::kSsimRadius;
using quell::kSsimTaps;

using Weights = std::array<double, kSsimTaps>;

Weights gaussian() {
  constexpr double kSigma = 1.5;
  Weights w{};
  double sum = 0;
  for (int k = 0; k < kSsimTaps; ++k)
    sum += w[std::size_t(k)] = std::exp(-(k - kSsimRadius) * (k - kSsimRadius) / (2 * kSigma * kSigma));
  for (double& v : w) v /= sum;
  return w;
}

struct Ssim {
  quell::In<quell::Any> image, reference;
  quell::Out<quell::Scalar> map, contrast, inside;

  void describe(quell::Describe& d) {
    d.summary("Compares the structure of two images around each pixel: means, contrast and correlation.");
    d.source(
        "Wang et al. 2004, Image Quality Assessment: From Error Visibility to Structural Similarity, eq. 6, 12 and 13: "
        "an 11×11 Gaussian of sigma 1.5, K1 = 0.01, K2 = 0.03, L = 1, population variances.");
    d.in(image, "image", "What is judged, encoded to [0,1].").halo(kSsimRadius);
    d.in(reference, "reference", "What it is judged by, encoded alike.").halo(kSsimRadius);
    d.out(map, "map", "SSIM = l·cs, the mean over channels: 1 where equal, about 0 where unrelated, and at least -1.");
    d.out(contrast, "contrast", "cs = (2σxy + C2) / (σx² + σy² + C2) alone, as the finer scales of MS-SSIM take it.");
    d.out(inside, "inside",
          "1 where the window lies in the image, else 0: the mean is taken over those pixels. Elsewhere the border's "
          "pixels are repeated.");
  }

  void shapes(const quell_spec& spec, quell_shape* out) const {
    const auto &a = spec.in[image.index], &b = spec.in[reference.index];
    if (a.channels != b.channels) throw std::runtime_error("image and reference must have as many channels");
    for (const auto port : {map.index, contrast.index, inside.index}) out[port] = {a.width, a.height, 1};
  }

  Weights prepare(const quell_spec&) const { return gaussian(); }

  void run(const quell::Tile& tile, const Weights& weights) const {
    const quell_image& size = tile[image];
    std::vector<double> scratch(std::size_t(quell::ssim_scratch(tile.x0, tile.x1)));
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int c = 0; c < size.channels; ++c) {
        quell::SsimRow row{};
        for (int k = 0; k < kSsimTaps; ++k) {
          const int v = std::clamp(y + k - kSsimRadius, 0, size.height - 1);
          row.image[k] = tile.row(image, c, v), row.reference[k] = tile.row(reference, c, v);
        }
        row.weight = weights.data();
        row.width = size.width, row.x0 = tile.x0, row.x1 = tile.x1;
        row.share = 1.0 / size.channels, row.first = c == 0;
        quell::ssim_row(row, scratch.data(), tile.row(map, 0, y), tile.row(contrast, 0, y));
      }
      const bool row_inside = y >= kSsimRadius && y < size.height - kSsimRadius;
      for (int x = tile.x0; x < tile.x1; ++x)
        tile.row(inside, 0, y)[x] = row_inside && x >= kSsimRadius && x < size.width - kSsimRadius ? 1.0f : 0.0f;
    }
  }
};

}  // namespace
QUELL_PLUGIN("ssim", Ssim)
