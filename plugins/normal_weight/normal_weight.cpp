// Keeps a filter from crossing a change of orientation.
#include "normal_weight/normal_weight_kernels.h"

#include <quell/falloff.h>
#include <quell/node.h>

#include <stdexcept>

namespace {

enum class Mode : std::int32_t { power, angle, difference };

struct NormalWeight {
  quell::In<quell::Normal> normal;
  quell::Out<quell::Weight> weight;
  Mode mode = Mode::power;
  float power = 128.0f;
  float sigma = 0.1f;
  float scale = 1.0f;
  quell::Falloff falloff = quell::Falloff::gaussian;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how nearly its normal is the centre's.");
    d.source(
        "power: Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, eq. 4; angle: a Gaussian of the angle, "
        "as in the joint bilateral filter of GAMES202 homework 5; difference: Dammertz et al. 2010, Edge-Avoiding "
        "À-Trous Wavelet Transform for fast Global Illumination Filtering");
    d.in(normal, "normal", "World-space unit normals; (0,0,0) is a miss, which only other misses are like.");
    d.out(weight, "weight",
          "power: max(0, n·n')^power. angle and difference: the falloff of D = acos(n·n'), n·n' clamped to [0,1], or "
          "D = |n - n'|; gaussian: exp(-D² / 2 sigma²).");
    d.param(mode, "mode", "What falls: a power of the cosine, or a falloff of the angle or of the difference.",
            {"power", "angle", "difference"});
    d.param(power, "power", "Of the cosine, in mode power; higher is stricter.").range(1.0f, 4096.0f);
    d.param(sigma, "sigma",
            "Unit of D in modes angle (radians) and difference, of the gaussian its standard deviation.")
        .range(1e-3f, 10.0f);
    d.param(scale, "scale",
            "Multiplies sigma: Dammertz's levels take their step for it, for normals change the more the farther apart "
            "they are.")
        .range(1e-4f, 1e4f);
    quell::describe_falloff(d, falloff);
  }

  void shapes(const quell_spec&, quell_shape*) const {
    if (mode == Mode::power && falloff != quell::Falloff::gaussian)
      throw std::runtime_error(
          "mode power takes no falloff, for the power of the cosine is one itself: set mode to angle or difference, or "
          "leave falloff at gaussian");
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell::NormalPlanes n{quell::plane(in, normal, 0), quell::plane(in, normal, 1), quell::plane(in, normal, 2)};
    switch (mode) {
      case Mode::power:
        return quell::normal_weigh_power(run, n, power, exponent);
      case Mode::angle:
        return quell::normal_weigh_angle(run, n, falloff, sigma * scale, exponent);
      case Mode::difference:
        return quell::normal_weigh_difference(run, n, falloff, sigma * scale, exponent);
    }
  }
};

}  // namespace
QUELL_PLUGIN("normal_weight", NormalWeight)
