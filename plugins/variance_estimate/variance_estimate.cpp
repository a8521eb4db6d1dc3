// Estimates how noisy each pixel is: over time where it has a past, over its neighbourhood where it has none.
#include "variance_estimate/variance_estimate_kernels.h"

#include <quell/node.h>

namespace {

struct VarianceEstimate {
  quell::In<quell::Radiance> image;
  quell::In<quell::Moments> moments;
  quell::In<quell::Count> count;
  quell::InList<quell::Weight> weights;
  quell::Out<quell::Radiance> steadied;
  quell::Out<quell::Variance> variance;
  int radius = 3;
  int min_count = 4;

  void describe(quell::Describe& d) {
    d.summary(
        "Gives the variance of luminance, from accumulated moments or, for young pixels, from the pixels around.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.2; the boost of young pixels is that "
        "of Falcor's SVGF pass");
    d.in(image, "image", "Accumulated radiance.").halo(radius);
    d.in(moments, "moments", "Accumulated first and second moment of luminance.").halo(radius);
    d.in(count, "count", "Frames accumulated.");
    d.in(weights, "weights", "Edge-stopping functions of the neighbourhood's mean; without any all pixels count alike.")
        .halo(radius);
    d.out(steadied, "image", "The image; where count < min_count, its weighted mean over the neighbourhood.")
        .passes(image);
    d.out(variance, "variance",
          "max(0, m2 - m1²); where count < min_count, of the weighted mean of the moments, times 4 / count.");
    d.param(radius, "radius", "Half-width of the neighbourhood, pixels.").range(1, 8);
    d.param(min_count, "min_count", "Frames from which on the moments of the pixel alone are trusted.").range(1, 64);
  }

  void run(const quell::Tile& tile) const {
    const quell_image &in = tile[image], &m = tile[moments];
    const auto taps = quell::square_taps(radius, 1, in.pitch, [](int, int) { return 1.0; });
    auto gather = quell::gather_of(taps, tile[weights], in);
    gather.planes.insert(gather.planes.end(), m.plane, m.plane + 2);
    const quell_image& out = tile[steadied];
    quell::variance_estimate_tile({std::move(gather),
                                   tile[count].plane[0],
                                   float(min_count),
                                   {out.plane[0], out.plane[1], out.plane[2]},
                                   tile[variance].plane[0]},
                                  tile);
  }
};

}  // namespace
QUELL_PLUGIN("variance_estimate", VarianceEstimate)
