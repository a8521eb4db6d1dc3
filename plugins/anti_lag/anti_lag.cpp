// Makes history forget where the light has changed.
#include <quell/node.h>

#include "anti_lag/anti_lag_kernels.h"

namespace {

struct AntiLagNode {
  quell::In<quell::Radiance> current;
  quell::In<quell::Radiance> history;
  quell::In<quell::Count> count;
  quell::Out<quell::Count> shortened;
  int radius = 7;
  float deviations = 1.5f;
  float strength = 6.0f;

  void describe(quell::Describe& d) {
    d.summary(
        "Shortens the count of accumulated frames where the mean of this frame around a pixel differs from history's "
        "by more than their noise explains: a lamp that was switched, a shadow that moved.");
    d.source(
        "Our own: count · (1 − t), t = clip(strength · max(0, |m − h| − deviations · s) / max(m, h), 0, 1), with the "
        "means m and h of luminance over the window and the standard error s of their difference. The aim is that of "
        "Schied et al. 2018, Gradient Estimation for Real-Time Adaptive Temporal Filtering, without its second "
        "samples.");
    d.in(current, "current", "This frame, unfiltered.").halo(radius);
    d.in(history, "history", "Reprojected history; this frame stands in for it where count ≤ 1.").halo(radius);
    d.in(count, "count", "Frames accumulated, this one included (history_length).").halo(radius);
    d.out(shortened, "count", "The count, smaller where light changed, never below 1.").passes(count);
    d.param(radius, "radius", "Half-width of the window, pixels; no edges are seen.").range(1, 32);
    d.param(deviations, "deviations", "Difference that noise may make, standard errors.").range(0, 100);
    d.param(strength, "strength", "How fast history goes: multiplies the relative difference beyond that.")
        .range(0, 100);
  }

  void run(const quell::Tile& tile) const {
    const auto &now = tile[current], &then = tile[history];
    std::vector<float> memory;
    quell::anti_lag_tile({{now.plane[0], now.plane[1], now.plane[2]},
                          {then.plane[0], then.plane[1], then.plane[2]},
                          tile[count].plane[0],
                          now.pitch,
                          now.width,
                          now.height,
                          radius,
                          deviations,
                          strength},
                         tile, memory, tile[shortened].plane[0]);
  }
};

}  // namespace
QUELL_PLUGIN("anti_lag", AntiLagNode)
