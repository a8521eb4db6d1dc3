// What the ranges of a window are computed from, and the memory for it.
#pragma once

#include <cstddef>
#include <vector>

namespace quell {

struct WindowRange {
  const float* plane;  // at pixel (0, 0)
  std::ptrdiff_t pitch;
  int width, height;
  int radius;
  float k;
  bool without_center;
  float least_spread;  // sigma is at least this share of the mean
  double* sums[4];     // of values and their squares; the same without the row of the centre
  float *low, *high;   // the outcome, one number a pixel
};

class WindowMemory {
 public:
  WindowMemory(int columns, int radius) : stride_(std::size_t(columns + 2 * radius) + kSlack) {
    sums_.resize(4 * stride_);
    range_.resize(2 * stride_);
  }
  void lend(WindowRange& w) {
    for (std::size_t k = 0; k < 4; ++k) w.sums[k] = sums_.data() + k * stride_;
    w.low = range_.data();
    w.high = w.low + stride_;
  }

 private:
  static constexpr std::size_t kSlack = 16;  // a vector may reach past the last pixel
  std::size_t stride_;
  std::vector<double> sums_;
  std::vector<float> range_;
};

}  // namespace quell
