// Multiplies albedo back into filtered light, and adds what no kernel has seen.
#include <quell/node.h>

#include "demodulate/rgb.h"
#include "modulate/modulate_kernels.h"

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
    d.source("Schied et al. 2017, Spatiotemporal Variance-Guided Filtering.");
    d.in(image, "image", "Radiance over clipped albedo, as demodulate gives it.");
    d.in(albedo, "albedo", "The albedo that demodulate had.");
    d.in(emission, "emission", "Radiance to add: what split_emitters set aside.").optional();
    d.out(radiance, "image", "Radiance.").passes(image);
    rule.describe(d);
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      std::array<const float*, 3> more{};
      if (tile.has(emission)) more = quell::rgb(tile, emission, y);
      quell::modulate_row(rule, tile.x0, tile.x1, quell::rgb(tile, image, y).data(), quell::rgb(tile, albedo, y).data(),
                          more.data(), quell::rgb(tile, radiance, y).data());
    }
  }
};

}  // namespace
QUELL_PLUGIN("modulate", Modulate)
