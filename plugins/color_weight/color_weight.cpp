// Keeps a filter from crossing a change of colour, or of any other feature.
#include "color_weight/color_weight_kernels.h"

#include <quell/falloff.h>
#include <quell/node.h>

namespace {

struct ColorWeight {
  quell::In<quell::Any> image;
  quell::Out<quell::Weight> weight;
  float sigma = 0.6f;
  float scale = 1.0f;
  quell::Falloff falloff = quell::Falloff::gaussian;
  quell::ColorSpace space = quell::ColorSpace::linear;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how nearly its colour is the centre's.");
    d.source(
        "Tomasi and Manduchi 1998, Bilateral Filtering for Gray and Color Images; the scale: Dammertz et al. 2010, "
        "Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering");
    d.in(image, "image", "Colour, albedo or any other float image: what is filtered (bilateral) or a guide (joint).");
    d.out(weight, "weight",
          "The falloff of D = |c - c'|, the distance taken over all channels; gaussian: exp(-D² / 2 sigma²).");
    d.param(sigma, "sigma", "Unit of the distance, of the gaussian its standard deviation, in units of the image.")
        .range(1e-4f, 1e9f);
    d.param(scale, "scale",
            "Multiplies sigma: lets the levels of a filter share one sigma and each take its part of it, as 1, 0.5, "
            "0.25, … for levels that leave less and less noise.")
        .range(1e-4f, 1e4f);
    quell::describe_falloff(d, falloff);
    d.param(
        space, "space",
        "What distances and sigma are measured in. linear: the image as it is, so that a sigma fits one exposure. "
        "log: ±log(1 + |x|), where what is much brighter than 1 differs by its ratio. sqrt: ±√|x|, where noise that "
        "grows with the light is alike everywhere.",
        {"linear", "log", "sqrt"});
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell_image& guide = in[image.index].image[0];
    quell::color_weigh(run, guide.plane, guide.channels, {space, falloff, sigma * scale}, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("color_weight", ColorWeight)
