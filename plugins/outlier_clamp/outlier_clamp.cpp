// Pulls fireflies into the range that their neighbours support.
#include <quell/node.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "outlier_clamp/outlier_clamp_kernels.h"

namespace {

// Where the neighbours are all alike, leaving out the centre leaves no spread at all; this share of their mean is
// always allowed.
constexpr float kLeastSpread = 1e-3f;

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
            "√(N−1) sigma, whatever its size (2.8 for 3×3, 6.9 for 7×7), so that a larger k never finds it.");
    d.param(
        mode, "mode",
        "channel: each channel by itself, which may shift hue. luminance: RGB scaled as one by what luminance needs.",
        {"channel", "luminance"});
  }

  void run(const quell::Tile& tile) const {
    const auto& in = tile[image];
    quell::WindowMemory memory(tile.x1 - tile.x0, radius);
    quell::WindowRange window{nullptr, in.pitch, in.width,       in.height,
                              radius,  k,        exclude_center, exclude_center ? kLeastSpread : 0.0f,
                              {},      nullptr,  nullptr};
    memory.lend(window);
    if (mode == Mode::luminance) return by_luminance(tile, window);
    for (int c = 0; c < 3; ++c) {
      window.plane = in.plane[c];
      for (int y = tile.y0; y < tile.y1; ++y)
        quell::clamp_channel(window, y, tile.x0, tile.x1, tile.row(clamped, c, y));
    }
  }

 private:
  void by_luminance(const quell::Tile& tile, quell::WindowRange& window) const {
    // Luminance of the tile and what its windows reach.
    const int left = std::max(tile.x0 - radius, 0), right = std::min(tile.x1 + radius, window.width);
    const int top = std::max(tile.y0 - radius, 0), bottom = std::min(tile.y1 + radius, window.height);
    const std::ptrdiff_t pitch = (right - left + 15) / 16 * 16 + 16;  // vectors read past the last one
    std::vector<float> plane(std::size_t(pitch * (bottom - top)));
    window.pitch = pitch;
    window.plane = plane.data() - top * pitch - left;
    for (int y = top; y < bottom; ++y) {
      const float* const in[3] = {tile.row(image, 0, y), tile.row(image, 1, y), tile.row(image, 2, y)};
      quell::luminance_row(in, left, right, plane.data() + (y - top) * pitch - left);
    }
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* const in[3] = {tile.row(image, 0, y), tile.row(image, 1, y), tile.row(image, 2, y)};
      float* const out[3] = {tile.row(clamped, 0, y), tile.row(clamped, 1, y), tile.row(clamped, 2, y)};
      quell::clamp_luminance(window, y, tile.x0, tile.x1, in, out);
    }
  }
};

}  // namespace
QUELL_PLUGIN("outlier_clamp", OutlierClamp)
