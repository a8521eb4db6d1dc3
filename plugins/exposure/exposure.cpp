// Scales radiance by a power of two.
#include <quell/node.h>

#include <algorithm>
#include <cmath>

#include "exposure/exposure_kernels.h"

namespace {

// 2 to the power of more is no float.
constexpr double kMostStops = 126;

struct Exposure {
  quell::In<quell::Radiance> image;
  quell::In<quell::Value> more;
  quell::Out<quell::Radiance> exposed;
  float stops = 0;

  void describe(quell::Describe& d) {
    d.summary("Multiplies radiance by 2 to the power of a number of stops.");
    d.source("Image · 2^E.");
    d.in(image, "image", "Radiance.");
    d.in(more, "more", "Stops to add to the parameter, as `auto_exposure` gives them.").optional().anywhere();
    d.out(exposed, "image", "Radiance; the largest float where that would overflow.").passes(image);
    d.param(stops, "stops", "Stops: each doubles the light, and a negative one halves it.").range(-32, 32);
  }

  void run(const quell::Tile& tile) const {
    const double sum = double(stops) + (tile.has(more) ? double(*tile.row(more, 0, 0)) : 0.0);
    const auto factor = float(std::exp2(std::clamp(sum, -kMostStops, kMostStops)));
    for (int c = 0; c < 3; ++c)
      for (int y = tile.y0; y < tile.y1; ++y)
        quell::scale_row(factor, tile.x0, tile.x1, tile.row(image, c, y), tile.row(exposed, c, y));
  }
};

}  // namespace
QUELL_PLUGIN("exposure", Exposure)
