// Mean and standard deviation over a square window around each pixel, cut off at the image border.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace quell {

struct Statistics {
  double mean, sigma;
  int count;
};

// Sums over columns first and then along the row, each in one fixed order, so that a pixel's numbers depend on its
// window alone. In double, for the variance is a difference of sums. Leaving the centre out leaves it out of the sums:
// subtracting a firefly from them again would cost the very digits that its neighbours are in.
class Window {
 public:
  Window(int radius, bool without_center, int width, int height)
      : radius_(radius), without_center_(without_center), width_(width), height_(height) {}

  // Statistics of columns [x0, x1) of row y, of values value(x, y).
  template <class Value>
  const std::vector<Statistics>& row(int y, int x0, int x1, Value&& value) {
    const int left = std::max(x0 - radius_, 0), right = std::min(x1 + radius_, width_);
    const int top = std::max(y - radius_, 0), bottom = std::min(y + radius_ + 1, height_);
    columns_.assign(std::size_t(right - left), {});
    holes_.assign(std::size_t(right - left), {});
    for (int v = top; v < bottom; ++v)
      for (int u = left; u < right; ++u) {
        const double l = value(u, v);
        columns_[std::size_t(u - left)] += {l, l * l};
        if (without_center_ && v != y) holes_[std::size_t(u - left)] += {l, l * l};
      }
    result_.resize(std::size_t(x1 - x0));
    for (int x = x0; x < x1; ++x) {
      const int from = std::max(x - radius_, 0), to = std::min(x + radius_ + 1, width_);
      Sums s{};
      for (int u = from; u < to; ++u)
        s += without_center_ && u == x ? holes_[std::size_t(u - left)] : columns_[std::size_t(u - left)];
      const int count = (to - from) * (bottom - top) - (without_center_ ? 1 : 0);
      const double n = std::max(count, 1), mean = s.first / n;
      result_[std::size_t(x - x0)] = {mean, std::sqrt(std::max(s.second / n - mean * mean, 0.0)), count};
    }
    return result_;
  }

 private:
  struct Sums {
    double first = 0, second = 0;
    Sums& operator+=(const Sums& o) {
      first += o.first;
      second += o.second;
      return *this;
    }
  };

  int radius_;
  bool without_center_;
  int width_, height_;
  std::vector<Sums> columns_, holes_;  // of each column of the window, with and without row y
  std::vector<Statistics> result_;
};

// `v` moved into mean ± reach.
inline float clamp_around(float v, double mean, double reach) {
  return std::min(std::max(v, float(mean - reach)), float(mean + reach));
}

}  // namespace quell
