// Pulls fireflies into the range that their neighbours support.
#include <quell/node.h>

#include <cmath>
#include <cstdint>

#include "outlier_clamp/window.h"

namespace {

// Where the neighbours are all alike, leaving out the centre leaves no spread at all; this share of their mean is
// always allowed.
constexpr double kLeastSpread = 1e-3;

enum class Mode : std::int32_t { channel, luminance };

struct OutlierClamp {
  quell::In<quell::Radiance> image;
  quell::Out<quell::Radiance> clamped;
  int radius = 3;
  float k = 2.0f;
  bool exclude_center = true;
  Mode mode = Mode::channel;

  void describe(quell::Describe& d) {
    d.summary(
        "Clamps each value into mean ± k·sigma of its neighbourhood. Biased: it takes energy from true highlights "
        "too.");
    d.source("GAMES202 lecture 13, outlier removal.");
    d.in(image, "image", "Noisy radiance.").halo(radius);
    d.out(clamped, "image", "Radiance without outliers; nothing is zeroed.").passes(image);
    d.param(radius, "radius", "Half-width of the neighbourhood, pixels.").range(1, 16);
    d.param(k, "k", "Half-width of the accepted range, standard deviations.").range(0, 1e6);
    d.param(exclude_center, "exclude_center",
            "Leave the pixel itself out of the statistics. Within them, one outlier among N equal values lies at "
            "√(N−1) sigma, "
            "whatever its size (2.8 for 3×3, 6.9 for 7×7), so that a larger k never finds it.");
    d.param(
        mode, "mode",
        "channel: each channel by itself, which may shift hue. luminance: RGB scaled as one by what luminance needs.",
        {"channel", "luminance"});
  }

  void run(const quell::Tile& tile) const {
    const auto& in = tile[image];
    quell::Window window(radius, exclude_center, in.width, in.height);
    for (int y = tile.y0; y < tile.y1; ++y) {
      if (mode == Mode::channel)
        clamp_channels(tile, window, y);
      else
        clamp_luminance(tile, window, y);
    }
  }

  void clamp_channels(const quell::Tile& tile, quell::Window& window, int y) const {
    for (int c = 0; c < 3; ++c) {
      const float* plane = tile.row(image, c, 0);
      const auto pitch = tile[image].pitch;
      const auto& stats = window.row(y, tile.x0, tile.x1, [&](int u, int v) { return double(plane[v * pitch + u]); });
      for (int x = tile.x0; x < tile.x1; ++x)
        tile.row(clamped, c, y)[x] = pull(plane[y * pitch + x], stats[std::size_t(x - tile.x0)]);
    }
  }

  void clamp_luminance(const quell::Tile& tile, quell::Window& window, int y) const {
    const auto luminance = [&](int u, int v) {
      return 0.2126f * tile.row(image, 0, v)[u] + 0.7152f * tile.row(image, 1, v)[u] +
             0.0722f * tile.row(image, 2, v)[u];
    };
    const auto& stats = window.row(y, tile.x0, tile.x1, luminance);
    for (int x = tile.x0; x < tile.x1; ++x) {
      const float l = luminance(x, y), to = pull(l, stats[std::size_t(x - tile.x0)]);
      for (int c = 0; c < 3; ++c) {
        const float v = tile.row(image, c, y)[x];
        tile.row(clamped, c, y)[x] = l > 0 && to != l ? v * (to / l) : v;
      }
    }
  }

  float pull(float v, const quell::Statistics& s) const {
    if (s.count < 2) return v;
    const double sigma = exclude_center ? std::max(s.sigma, kLeastSpread * std::abs(s.mean)) : s.sigma;
    return quell::clamp_around(v, s.mean, k * sigma);
  }
};

}  // namespace
QUELL_PLUGIN("outlier_clamp", OutlierClamp)
