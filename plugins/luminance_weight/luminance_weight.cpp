// Keeps a filter from crossing a change of brightness that is no noise.
#include "luminance_weight/luminance_weight_kernels.h"

#include <quell/falloff.h>
#include <quell/node.h>

namespace {

struct LuminanceWeight {
  quell::In<quell::Radiance> image;
  quell::In<quell::Variance> variance;
  quell::Out<quell::Weight> weight;
  float sigma = 4.0f;
  float epsilon = 1e-4f;
  quell::Falloff falloff = quell::Falloff::exponential;

  void describe(quell::Describe& d) {
    d.summary(
        "Weighs a neighbour by how nearly its luminance is the centre's, measured in standard deviations of noise.");
    d.source("Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, eq. 5");
    d.in(image, "image", "Radiance whose luminance (0.2126, 0.7152, 0.0722) is compared.");
    d.in(variance, "variance",
         "Variance of the luminance, read at the centre. Without it sigma is in units of radiance.")
        .optional();
    d.out(weight, "weight",
          "The falloff of D = |l - l'|, in units of sigma sqrt(variance) + epsilon with a variance, of sigma without; "
          "exponential: exp(-|l - l'| / (sigma sqrt(variance) + epsilon)).");
    d.param(sigma, "sigma",
            "Unit of the difference, which costs the exponential a factor of e: standard deviations, or radiance "
            "without a variance.")
        .range(1e-6f, 1e9f);
    d.param(epsilon, "epsilon", "Difference that is free where the variance is 0, radiance.").range(1e-10f, 1.0f);
    quell::describe_falloff(d, falloff);
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell::RgbPlanes rgb{quell::plane(in, image, 0), quell::plane(in, image, 1), quell::plane(in, image, 2)};
    const float* v = quell::has(in, variance) ? quell::plane(in, variance, 0) : nullptr;
    quell::luminance_weigh(run, rgb, v, {falloff, sigma, epsilon}, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("luminance_weight", LuminanceWeight)
