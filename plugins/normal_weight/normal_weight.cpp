// Keeps a filter from crossing a change of orientation.
#include "normal_weight/normal_weight_kernels.h"

#include <quell/node.h>

namespace {

enum class Mode : std::int32_t { power, angle };

struct NormalWeight {
  quell::In<quell::Normal> normal;
  quell::Out<quell::Weight> weight;
  Mode mode = Mode::power;
  float power = 128.0f;
  float sigma = 0.1f;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how nearly its normal is the centre's.");
    d.source(
        "power: Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, eq. 4; angle: a Gaussian of the angle, "
        "as in the joint bilateral filter of GAMES202 homework 5");
    d.in(normal, "normal", "World-space unit normals; (0,0,0) is a miss, which only other misses are like.");
    d.out(weight, "weight", "power: max(0, n·n')^power. angle: exp(-acos²(n·n') / 2 sigma²), n·n' clamped to [0,1].");
    d.param(mode, "mode", "Falloff.", {"power", "angle"});
    d.param(power, "power", "Of the cosine, in mode power; higher is stricter.").range(1.0f, 4096.0f);
    d.param(sigma, "sigma", "Standard deviation of the angle, radians, in mode angle.").range(1e-3f, 10.0f);
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell::NormalPlanes n{quell::plane(in, normal, 0), quell::plane(in, normal, 1), quell::plane(in, normal, 2)};
    if (mode == Mode::power)
      quell::normal_weigh_power(run, n, power, exponent);
    else
      quell::normal_weigh_angle(run, n, sigma, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("normal_weight", NormalWeight)
