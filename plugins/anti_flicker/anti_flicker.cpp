// Tells where history is about to be clamped again and again, so that blending can go slowly there.
#include <quell/node.h>

#include <algorithm>
#include <vector>

#include "anti_flicker/anti_flicker_kernels.h"

namespace {

struct AntiFlicker {
  quell::In<quell::Radiance> history;
  quell::In<quell::Radiance> current;
  quell::Out<quell::Scalar> factor;
  int radius = 1;
  float k = 1.0f;
  bool compress = false;

  void describe(quell::Describe& d) {
    d.summary(
        "Gives a factor on the weight of this frame: small where luma of history lies near an end of the current "
        "range, "
        "where what flickers does.");
    d.source("The anti-aliasing pass of Falcor; Karis 2014, High Quality Temporal Supersampling.");
    d.in(history, "history", "Reprojected history, before it is clamped.");
    d.in(current, "current", "This frame.").halo(radius);
    d.out(factor, "factor",
          "d / (d + high − low), 0 to 1, where luma (R + 2G + B)/4 of the current frame ranges from low to high around "
          "the pixel and that of history lies d from the nearer end; 1 where all are equal. For temporal_blend.");
    d.param(radius, "radius", "Half-width of the neighbourhood, pixels.").range(1, 16);
    d.param(k, "k", "Half-width of the range about the mean of the neighbourhood, standard deviations.").range(0, 1e6);
    d.param(compress, "compress", "Take luma on the scale of log(1 + x), as temporal_clamp with compress does.");
  }

  void run(const quell::Tile& tile) const {
    const auto& now = tile[current];
    const int left = std::max(tile.x0 - radius, 0), right = std::min(tile.x1 + radius, now.width);
    const int top = std::max(tile.y0 - radius, 0), bottom = std::min(tile.y1 + radius, now.height);
    const std::ptrdiff_t pitch = right - left + 16;  // vectors read past the last pixel
    std::vector<float> luma(std::size_t(pitch * (bottom - top))), then(std::size_t(tile.x1 - tile.x0 + 16));
    for (int y = top; y < bottom; ++y)
      quell::luma_row(rgb(tile, current, y).v, compress, left, right, luma.data() + (y - top) * pitch - left);

    quell::WindowMemory memory(tile.x1 - tile.x0, radius);
    quell::WindowRange window{
        luma.data() - top * pitch - left, pitch, now.width, now.height, radius, k, false, 0.0f, {}, nullptr, nullptr};
    memory.lend(window);
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* const before = then.data() - tile.x0;
      quell::luma_row(rgb(tile, history, y).v, compress, tile.x0, tile.x1, before);
      quell::flicker_row(window, y, tile.x0, tile.x1, before, tile.row(factor, 0, y));
    }
  }

 private:
  struct Rgb {
    const float* v[3];
  };
  static Rgb rgb(const quell::Tile& tile, quell::In<quell::Radiance> port, int y) {
    return {{tile.row(port, 0, y), tile.row(port, 1, y), tile.row(port, 2, y)}};
  }
};

}  // namespace
QUELL_PLUGIN("anti_flicker", AntiFlicker)
