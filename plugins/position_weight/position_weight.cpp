// Keeps a filter near the centre in the world, however near the pixels are.
#include "position_weight/position_weight_kernels.h"

#include <quell/falloff.h>
#include <quell/node.h>

namespace {

struct PositionWeight {
  quell::In<quell::Position> position;
  quell::Out<quell::Weight> weight;
  float sigma = 0.2f;
  quell::Falloff falloff = quell::Falloff::gaussian;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how near it is to the centre in the world.");
    d.source(
        "Dammertz et al. 2010, Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering: the "
        "position weight, with 2 sigma² for their sigma²");
    d.in(position, "position", "World-space positions; (0,0,0) is a miss, which only other misses are like.");
    d.out(weight, "weight", "The falloff of D = |p - p'|; gaussian: exp(-D² / 2 sigma²).");
    d.param(sigma, "sigma", "Unit of the distance, of the gaussian its standard deviation, scene units.")
        .range(1e-6f, 1e6f);
    quell::describe_falloff(d, falloff);
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell::PositionPlanes p{quell::plane(in, position, 0), quell::plane(in, position, 1),
                                  quell::plane(in, position, 2)};
    quell::position_weigh(run, p, falloff, sigma, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("position_weight", PositionWeight)
