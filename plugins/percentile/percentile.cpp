// One number of a frame that outliers cannot move.
#include <quell/node.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace {

struct Percentile {
  quell::In<quell::Any> image;
  quell::In<quell::Scalar> mask;
  quell::Out<quell::Value> value;
  float share = 0.5f;
  bool positive = false;
  bool weighted = false;

  void describe(quell::Describe& d) {
    d.summary("Finds the number below which a share of an image's pixels lie: the median, a dark end, the brightest.");
    d.source("weighted: Andersson et al. 2021, Visualizing and Communicating Errors in Rendered Images.");
    d.in(image, "image", "Luminance (0.2126, 0.7152, 0.0722) of three channels; the first of any other number.")
        .anywhere();
    d.in(mask, "mask", "Pixels above 0 enter; without it, all do.").optional().anywhere();
    d.out(value, "value",
          "Of the n numbers in order, the one at share·n, rounded down and counted from 0, or the last; 0 without any. "
          "Weighted, the first up to which their sum exceeds share times the sum of all, or the last.");
    d.param(share, "share", "Share of the numbers that are smaller. 0: the smallest, 0.5: the median, 1: the largest.")
        .range(0, 1);
    d.param(
        positive, "positive",
        "Only numbers above 0 enter, for what is divided by or has a logarithm taken: half of a frame may be black.");
    d.param(weighted, "weighted",
            "Each number weighs as much as it is large: 0.5 is the error that half of all error lies at or below. "
            "Numbers below 0 do not enter.");
  }

  void run(const quell::Tile& tile) const {
    std::vector<float> values;
    const quell_image& from = tile[image];
    for (int y = 0; y < from.height; ++y) {
      const float* const marked = tile.has(mask) ? tile.row(mask, 0, y) : nullptr;
      for (int x = 0; x < from.width; ++x) {
        if (marked && !(marked[x] > 0)) continue;
        const float v = brightness(from, y * from.pitch + x);
        // Numbers that are not finite have no place in an order.
        if (std::isfinite(v) && (!positive || v > 0) && (!weighted || v >= 0)) values.push_back(v);
      }
    }
    *tile.row(value, 0, 0) = values.empty() ? 0.0f : weighted ? at_weight(values) : at_share(values);
  }

 private:
  static float brightness(const quell_image& i, std::ptrdiff_t at) {
    if (i.channels != 3) return i.plane[0][at];
    return float(0.2126 * i.plane[0][at] + 0.7152 * i.plane[1][at] + 0.0722 * i.plane[2][at]);
  }
  float at_share(std::vector<float>& values) const {
    const auto last = values.size() - 1;
    const auto at = values.begin() + std::ptrdiff_t(std::min(last, std::size_t(double(share) * double(values.size()))));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }
  // Sorted, so that the sums have one order whatever that of the pixels.
  float at_weight(std::vector<float>& values) const {
    std::ranges::sort(values);
    const double limit = double(share) * std::accumulate(values.begin(), values.end(), 0.0);
    double sum = 0;
    for (const float v : values)
      if ((sum += v) > limit) return v;
    return values.back();
  }
};

}  // namespace
QUELL_PLUGIN("percentile", Percentile)
