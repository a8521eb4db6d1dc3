// Keeps a filter on the plane that the centre's surface lies in.
#include "plane_weight/plane_weight_kernels.h"

#include <quell/falloff.h>
#include <quell/node.h>

namespace {

enum class Mode : std::int32_t { sine, distance };

struct PlaneWeight {
  quell::In<quell::Normal> normal;
  quell::In<quell::Position> position;
  quell::Out<quell::Weight> weight;
  Mode mode = Mode::sine;
  float sigma = 0.1f;
  quell::Falloff falloff = quell::Falloff::gaussian;

  void describe(quell::Describe& d) {
    d.summary("Weighs a neighbour by how nearly it lies in the centre's tangent plane.");
    d.source(
        "sine: plane metric of GAMES202 homework 5; distance: the same, not divided by the distance of the points");
    d.in(normal, "normal", "World-space unit normals; (0,0,0) is a miss, which only other misses are like.");
    d.in(position, "position", "World-space positions.");
    d.out(weight, "weight",
          "The falloff of D = |n·(p' - p)| / |p' - p| (sine; 0 where the points coincide) or |n·(p' - p)| (distance); "
          "gaussian: exp(-D² / 2 sigma²).");
    d.param(mode, "mode", "Metric: the sine of the elevation over the plane, without scale, or the distance from it.",
            {"sine", "distance"});
    d.param(sigma, "sigma", "Unit of D, of the gaussian its standard deviation: a sine, or scene units.")
        .range(1e-4f, 1e6f);
    quell::describe_falloff(d, falloff);
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const quell::PlaneGuides guides{quell::plane(in, position, 0), quell::plane(in, position, 1),
                                    quell::plane(in, position, 2), quell::plane(in, normal, 0),
                                    quell::plane(in, normal, 1),   quell::plane(in, normal, 2)};
    if (mode == Mode::sine)
      quell::plane_weigh_sine(run, guides, falloff, sigma, exponent);
    else
      quell::plane_weigh_distance(run, guides, falloff, sigma, exponent);
  }
};

}  // namespace
QUELL_PLUGIN("plane_weight", PlaneWeight)
