// Variance of a pixel from two renderings of it with half of the samples each.
#include <quell/node.h>

namespace {

struct HalfBufferVariance {
  quell::In<quell::Radiance> a, b;
  quell::Out<quell::Radiance> image;
  quell::Out<quell::Variance> variance;

  void describe(quell::Describe& d) {
    d.summary("The mean of two half buffers, and an estimate of its variance from their difference.");
    d.source(
        "Rousselle et al. 2012, Adaptive Rendering with Non-Local Means Filtering; Bitterli et al. 2016, Nonlinearly "
        "Weighted First-order Regression for Denoising Monte Carlo Renderings");
    d.in(a, "a", "Radiance of one half of the samples, independent of the other.");
    d.in(b, "b", "Radiance of the other half, as many samples.");
    d.out(image, "image", "(a + b) / 2.").passes(a);
    d.out(
        variance, "variance",
        "(l − l')² / 4, the variance of the mean's luminance: right on average and very noisy, so smooth it before it "
        "steers anything (gaussian, kernel box, radius 1 to 4).");
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *r = tile.row(a, 0, y), *g = tile.row(a, 1, y), *bl = tile.row(a, 2, y);
      const float *r2 = tile.row(b, 0, y), *g2 = tile.row(b, 1, y), *bl2 = tile.row(b, 2, y);
      float* out = tile.row(variance, 0, y);
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float l = 0.2126f * (r[x] - r2[x]) + 0.7152f * (g[x] - g2[x]) + 0.0722f * (bl[x] - bl2[x]);
        out[x] = 0.25f * (l * l);
      }
      for (int c = 0; c < 3; ++c) {
        const float *first = tile.row(a, c, y), *second = tile.row(b, c, y);
        float* mean = tile.row(image, c, y);
        for (int x = tile.x0; x < tile.x1; ++x) mean[x] = 0.5f * (first[x] + second[x]);
      }
    }
  }
};

}  // namespace
QUELL_PLUGIN("half_buffer_variance", HalfBufferVariance)
