// Keeps a filter from crossing a step in depth, and lets it run along a surface that recedes.
#include "depth_weight/depth_weight_kernels.h"

#include <quell/falloff.h>
#include <quell/node.h>

namespace {

struct DepthWeight {
  quell::In<quell::Depth> depth;
  quell::In<quell::Slope> slope;
  quell::Out<quell::Weight> weight;
  float sigma = 1.0f;
  float epsilon = 1e-4f;
  bool relative = false;
  quell::Falloff falloff = quell::Falloff::exponential;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how nearly its depth is what the centre's surface would have there.");
    d.source("Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, eq. 3");
    d.in(depth, "depth", "Linear distance along the view axis; a miss is like other misses only.");
    d.in(slope, "slope", "Change of depth a pixel. Without it depths are compared as they are.").optional();
    d.out(weight, "weight",
          "The falloff of D = |z - z'|, in units of sigma |slope·(p - p')| + epsilon with a slope, of sigma without; "
          "exponential: exp(-|z - z'| / (sigma |slope·(p - p')| + epsilon)).");
    d.param(sigma, "sigma",
            "Unit of the deviation, which costs the exponential a factor of e: with a slope, as a multiple of the "
            "change that the slope foretells; without, in scene units.")
        .range(1e-4f, 1e6f);
    d.param(epsilon, "epsilon", "Deviation that is free where the slope foretells none, scene units.")
        .range(1e-8f, 1.0f);
    d.param(relative, "relative",
            "Measures epsilon (with a slope) or sigma (without) as a share of the centre's depth, so that they hold at "
            "any scale of the scene.");
    quell::describe_falloff(d, falloff);
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell::DepthFalloff by{falloff, sigma, epsilon, relative};
    const float* z = quell::plane(in, depth, 0);
    if (quell::has(in, slope))
      quell::depth_weigh_sloped(run, z, quell::plane(in, slope, 0), quell::plane(in, slope, 1), by, exponent);
    else
      quell::depth_weigh_plain(run, z, by, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("depth_weight", DepthWeight)
