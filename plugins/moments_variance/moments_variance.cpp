// Variance from the two moments of luminance.
#include <quell/node.h>

#include <algorithm>

namespace {

struct MomentsVariance {
  quell::In<quell::Moments> moments;
  quell::Out<quell::Variance> variance;

  void describe(quell::Describe& d) {
    d.summary("The variance that two raw moments imply.");
    d.source(
        "Schied et al. 2017, Spatiotemporal Variance-Guided Filtering, section 4.2; taken anew from filtered moments "
        "at "
        "every level in Quake II RTX and in NVIDIA's ReLAX");
    d.in(moments, "moments", "First and second raw moment of luminance, as they are or filtered.");
    d.out(variance, "variance", "max(0, E[l²] − E[l]²).");
  }

  void run(const quell::Tile& tile) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *first = tile.row(moments, 0, y), *second = tile.row(moments, 1, y);
      float* out = tile.row(variance, 0, y);
      // In double: a small difference of large numbers.
      for (int x = tile.x0; x < tile.x1; ++x)
        out[x] = float(std::max(0.0, double(second[x]) - double(first[x]) * double(first[x])));
    }
  }
};

}  // namespace
QUELL_PLUGIN("moments_variance", MomentsVariance)
