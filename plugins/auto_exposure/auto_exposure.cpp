// The second half of a reduction: block averages become one number.
#include <quell/node.h>

#include <cmath>

namespace {

// A darker block says nothing of what the frame shows.
constexpr float kDark = 1e-8f;

struct AutoExposure {
  quell::In<quell::Scalar> blocks;
  quell::Out<quell::Value> stops;
  float key = 0.18f;

  void describe(quell::Describe& d) {
    d.summary("How many stops bring the logarithmic average of a frame to a key: log2 key − mean log2 blocks.");
    d.source("Reinhard et al. 2002, eq. 1 and 2, over blocks as Open Image Denoise does.");
    d.in(blocks, "blocks", "Averages of blocks, as `block_average` gives them. Those up to 1e-8 do not count.")
        .anywhere();
    d.out(stops, "stops", "Stops for `exposure`; 0 where no block counts.");
    d.param(key, "key", "What the average becomes, radiance: 0.18 is a grey card.").range(1e-6, 1e6);
  }

  void run(const quell::Tile& tile) const {
    const auto& image = tile[blocks];
    double sum = 0;
    std::int64_t count = 0;
    for (int y = 0; y < image.height; ++y) {
      double row = 0;
      for (int x = 0; x < image.width; ++x) {
        const float v = image.plane[0][y * image.pitch + x];
        if (v > kDark && std::isfinite(v)) row += std::log2(double(v)), ++count;
      }
      sum += row;
    }
    *tile.row(stops, 0, 0) = count ? float(std::log2(double(key)) - sum / double(count)) : 0.0f;
  }
};

}  // namespace
QUELL_PLUGIN("auto_exposure", AutoExposure)
