// Keeps a filter from crossing a change of colour, or of any other feature.
#include "color_weight/color_weight_kernels.h"

#include <quell/node.h>

namespace {

struct ColorWeight {
  quell::In<quell::Any> image;
  quell::Out<quell::Weight> weight;
  float sigma = 0.6f;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how nearly its colour is the centre's.");
    d.source("Tomasi and Manduchi 1998, Bilateral Filtering for Gray and Color Images");
    d.in(image, "image", "Colour, albedo or any other float image: what is filtered (bilateral) or a guide (joint).");
    d.out(weight, "weight", "exp(-|c - c'|² / 2 sigma²), the distance taken over all channels.");
    d.param(sigma, "sigma", "Standard deviation of the distance, in units of the image.").range(1e-4f, 1e9f);
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell_image& guide = in[image.index].image[0];
    quell::color_weigh(run, guide.plane, guide.channels, sigma, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("color_weight", ColorWeight)
