// Keeps a filter from crossing a change of texture, where texture has not been divided out.
#include "albedo_weight/albedo_weight_kernels.h"

#include <quell/falloff.h>
#include <quell/node.h>

namespace {

struct AlbedoWeight {
  quell::In<quell::Albedo> albedo;
  quell::Out<quell::Weight> weight;
  float sigma = 0.05f;
  quell::Falloff falloff = quell::Falloff::gaussian;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how nearly its albedo is the centre's.");
    d.source("Dammertz et al. 2010 and GAMES202 lecture 13: any image without noise may guide a filter.");
    d.in(albedo, "albedo", "Linear reflectance. Needless where light is filtered by itself (demodulate).");
    d.out(weight, "weight",
          "The falloff of D = |a - a'|, the distance taken over R, G and B; gaussian: exp(-D² / 2 sigma²).");
    d.param(sigma, "sigma", "Unit of the distance, of the gaussian its standard deviation, reflectance.")
        .range(1e-4f, 1e3f);
    quell::describe_falloff(d, falloff);
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    quell::albedo_weigh(run, in[albedo.index].image[0].plane, falloff, sigma, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("albedo_weight", AlbedoWeight)
