// A map becomes one number a frame.
#include <quell/node.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace {

// Rows are summed in double, and then their sums from the top down: the same bits however the work is split.
struct Sums {
  double sum = 0;
  std::int64_t pixels = 0;
};

struct Mean {
  quell::In<quell::Scalar> map, mask;
  quell::Out<quell::Value> value, pixels;
  float trim = 0;

  void describe(quell::Describe& d) {
    d.summary("Averages an image to one number, over all pixels or those of a mask.");
    d.in(map, "map", "What to average.").anywhere();
    d.in(mask, "mask", "Pixels above 0 enter; without it, all do.").optional().anywhere();
    d.out(value, "value", "Their mean, summed in double; 0 where no pixel enters.");
    d.out(pixels, "pixels", "How many pixels entered, those that `trim` left out not counted.");
    d.param(trim, "trim", "Share of the pixels to leave out, the largest: fireflies say little of the rest.")
        .range(0, 0.5);
  }

  void run(const quell::Tile& tile) const {
    const auto sums = trim > 0 ? trimmed(tile) : sum_where(tile, [](float) { return true; });
    constexpr double most = std::numeric_limits<float>::max();
    const double mean = sums.pixels ? sums.sum / double(sums.pixels) : 0;
    // A map that is not a number anywhere, which no node should give, has a mean that says so.
    *tile.row(value, 0, 0) = float(std::clamp(mean, -most, most));
    *tile.row(pixels, 0, 0) = float(sums.pixels);
  }

 private:
  template <class Enters>
  Sums sum_where(const quell::Tile& tile, Enters enters) const {
    Sums all;
    each_row(tile, [&](const float* v, const float* m, int width) {
      double row = 0;
      for (int x = 0; x < width; ++x)
        if ((!m || m[x] > 0) && enters(v[x])) row += v[x], ++all.pixels;
      all.sum += row;
    });
    return all;
  }

  // All below the smallest of the largest, and as many equal to that as are left to keep.
  Sums trimmed(const quell::Tile& tile) const {
    std::vector<float> values;
    each_row(tile, [&](const float* v, const float* m, int width) {
      for (int x = 0; x < width; ++x)
        if (!m || m[x] > 0) values.push_back(v[x]);
    });
    const auto out = std::size_t(double(trim) * double(values.size()));
    if (out == 0) return sum_where(tile, [](float) { return true; });
    const auto smallest = values.begin() + std::ptrdiff_t(out - 1);
    std::nth_element(values.begin(), smallest, values.end(), std::greater<>());
    const float limit = *smallest;
    auto kept = sum_where(tile, [limit](float v) { return v < limit; });
    const auto equal = std::int64_t(values.size() - out) - kept.pixels;
    kept.sum += double(equal) * double(limit);
    kept.pixels += equal;
    return kept;
  }

  template <class Use>
  void each_row(const quell::Tile& tile, Use use) const {
    for (int y = 0; y < tile[map].height; ++y)
      use(tile.row(map, 0, y), tile.has(mask) ? tile.row(mask, 0, y) : nullptr, tile[map].width);
  }
};

}  // namespace
QUELL_PLUGIN("mean", Mean)
