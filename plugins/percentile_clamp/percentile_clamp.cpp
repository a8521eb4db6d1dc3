// Dims pixels that are brighter than the cluster of pixels that they lie in supports.
#include <quell/node.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct PercentileClamp {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Radiance> clamped;
  int size = 8;
  float low = 0.1f;
  float high = 0.9f;
  float k = 1.0f;

  void describe(quell::Describe& d) {
    d.summary(
        "Caps luminance by two percentiles of the cluster of pixels that each lies in; RGB is scaled as one. Biased: "
        "it "
        "takes energy from true highlights too.");
    d.source("Path tracers of KIT (merian): percentiles of clusters of 8×8 pixels, cap = high + k (high − low)");
    d.in(image, "image", "Noisy radiance.").halo(size - 1);
    d.out(clamped, "image",
          "C · min(1, cap / l), with the luminance l = 0.2126 R + 0.7152 G + 0.0722 B and cap = P(high) + k (P(high) − "
          "P(low)).")
        .passes(image);
    d.param(size, "size", "Side of the clusters, pixels. They lie side by side from the top left corner.").range(2, 64);
    d.param(low, "low", "Lower percentile P, a share: of n values sorted, number low · (n − 1), rounded down, from 0.")
        .range(0.0f, 1.0f);
    d.param(high, "high", "Upper percentile, a share likewise; not below the lower.").range(0.0f, 1.0f);
    d.param(k, "k", "How far above the upper percentile the cap lies, in distances of the two.").range(0.0f, 1000.0f);
  }

  void shapes(const quell_spec&, quell_shape*) const {
    if (low > high)
      throw std::runtime_error("low is " + std::to_string(low) + " and high is " + std::to_string(high) +
                               ": low must not exceed high");
  }

  void run(const quell::Tile& tile) const {
    const quell_image& in = tile[image];
    std::vector<float> light(std::size_t(size) * std::size_t(size)), sorted;
    for (int cy = tile.y0 / size * size; cy < tile.y1; cy += size)
      for (int cx = tile.x0 / size * size; cx < tile.x1; cx += size) {
        const int right = std::min(cx + size, in.width), bottom = std::min(cy + size, in.height), width = right - cx;
        for (int y = cy; y < bottom; ++y) luminances(tile, y, cx, right, light.data() + (y - cy) * width);
        sorted.assign(light.begin(), light.begin() + width * (bottom - cy));
        const float upper = percentile(sorted, high), lower = percentile(sorted, low);
        const float cap = upper + k * (upper - lower);
        for (int y = std::max(cy, tile.y0); y < std::min(bottom, tile.y1); ++y)
          apply(tile, y, cx, std::max(cx, tile.x0), std::min(right, tile.x1), light.data() + (y - cy) * width, cap);
      }
  }

 private:
  void luminances(const quell::Tile& tile, int y, int from, int to, float* out) const {
    const float *r = tile.row(image, 0, y), *g = tile.row(image, 1, y), *b = tile.row(image, 2, y);
    for (int x = from; x < to; ++x) *out++ = 0.2126f * r[x] + 0.7152f * g[x] + 0.0722f * b[x];
  }
  static float percentile(std::vector<float>& values, float share) {
    const auto n = std::ptrdiff_t(double(share) * double(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + n, values.end());
    return values[std::size_t(n)];
  }
  // Columns [from, to) of row y; the row of luminances begins at the cluster's left side.
  void apply(const quell::Tile& tile, int y, int left, int from, int to, const float* light, float cap) const {
    for (int c = 0; c < 3; ++c) {
      const float* v = tile.row(image, c, y);
      float* out = tile.row(clamped, c, y);
      for (int x = from; x < to; ++x) {
        const float l = light[x - left];
        out[x] = l > cap ? v[x] * (cap / l) : v[x];
      }
    }
  }
};

}  // namespace
QUELL_PLUGIN("percentile_clamp", PercentileClamp)
