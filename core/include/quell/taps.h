// Sets of taps, and what the gather engine of <quell/gather.h> is told: a filter is taps × weights.
#pragma once

#include <quell/abi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

namespace quell {

// The taps of a filter but for its centre, in mirrored pairs, with the logarithm of their kernel weights.
struct TapSet {
  std::vector<quell_tap> tap;
  std::vector<float> log2_kernel;
  float centre = 1;              // kernel weight of the centre
  int reach_x = 0, reach_y = 0;  // of the farthest tap

  // Adds (dx, dy) and (-dx, -dy), each with this kernel weight; none if it is 0.
  void add_pair(int dx, int dy, double kernel, std::ptrdiff_t pitch) {
    if (!(kernel > 0)) return;
    for (const int sign : {1, -1}) {
      tap.push_back({sign * (dy * pitch + dx), sign * dx, sign * dy});
      log2_kernel.push_back(float(std::log2(kernel)));
    }
    reach_x = std::max(reach_x, std::abs(dx));
    reach_y = std::max(reach_y, std::abs(dy));
  }
};

// All pixels (dx, dy) · step with |dx|, |dy| <= radius; kernel(dx, dy) is symmetric.
template <class Kernel>
TapSet square_taps(int radius, int step, std::ptrdiff_t pitch, Kernel kernel) {
  TapSet set;
  set.centre = float(kernel(0, 0));
  for (int dy = 0; dy <= radius; ++dy)
    for (int dx = dy ? -radius : 1; dx <= radius; ++dx) set.add_pair(dx * step, dy * step, kernel(dx, dy), pitch);
  return set;
}

// A weighted sum over taps, to be run on segments of rows.
struct Gather {
  const TapSet& taps;
  std::span<const quell_bound_weight> weights;
  std::vector<const float*> planes;  // the channels to sum, each weighted by w
  const float* variance = nullptr;   // a plane to sum weighted by w², as the variance of a weighted mean asks; or none
  int width = 0, height = 0;
  std::ptrdiff_t pitch = 0;
};

inline Gather gather_of(const TapSet& taps, std::span<const quell_bound_weight> weights, const quell_image& image) {
  return {taps, weights, {image.plane, image.plane + image.channels}, nullptr, image.width, image.height, image.pitch};
}

// Room for the sums of one segment: a row for each plane, then W = Σw, then Σw²·variance.
class Sums {
 public:
  static constexpr int kRow = QUELL_SEGMENT;
  explicit Sums(std::size_t planes) : planes_(planes), memory_((planes + 2) * kRow) {}
  float* plane(std::size_t i) { return memory_.data() + i * kRow; }
  float* weight() { return plane(planes_); }
  float* variance() { return plane(planes_ + 1); }

 private:
  std::size_t planes_;
  std::vector<float> memory_;
};

}  // namespace quell
