// Multiplies albedo back into filtered light, and adds what no kernel has seen.
#include <quell/node.h>

#include "demodulate/divisor.h"

namespace {

struct Modulate {
  quell::In<quell::Radiance> image;
  quell::In<quell::Albedo> albedo;
  quell::In<quell::Radiance> emission;
  quell::Out<quell::Radiance> radiance;
  quell::demodulation::Rule rule;

  void describe(quell::Describe& d) {
    d.summary(
        "Multiplies albedo into irradiance and adds emission. `demodulate` with the same parameters is its inverse.");
    d.source("Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.1.");
    d.in(image, "image", "Radiance over clipped albedo, as demodulate gives it.");
    d.in(albedo, "albedo", "The albedo that demodulate had.");
    d.in(emission, "emission", "Radiance to add: what split_emitters set aside.").optional();
    d.out(radiance, "image", "Radiance.").passes(image);
    rule.describe(d);
  }

  void run(const quell::Tile& tile) const {
    const bool has_emission = tile.has(emission);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const float a[3] = {tile.row(albedo, 0, y)[x], tile.row(albedo, 1, y)[x], tile.row(albedo, 2, y)[x]};
        float by[3];
        rule.divisor(a, by);
        for (int c = 0; c < 3; ++c) {
          const float reflected = tile.row(image, c, y)[x] * by[c];
          tile.row(radiance, c, y)[x] = has_emission ? reflected + tile.row(emission, c, y)[x] : reflected;
        }
      }
  }
};

}  // namespace
QUELL_PLUGIN("modulate", Modulate)
