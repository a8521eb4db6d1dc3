// The range mean ± k·sigma of the square window around each pixel, cut off at the image border. For *_kernels.cpp only.

#include <quell/simd.h>

#if defined(QUELL_WINDOW_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_WINDOW_H_
#undef QUELL_WINDOW_H_
#else
#define QUELL_WINDOW_H_
#endif

#include "outlier_clamp/window_range.h"

QUELL_SIMD_BEGIN

using D = hn::ScalableTag<double>;
using VD = hn::Vec<D>;
constexpr D dd;
constexpr hn::Rebind<float, D> half;
constexpr int kDoubles = int(hn::MaxLanes(dd));

// Sums of each column of the window, with and without row y. Columns beside the image sum to 0.
HWY_INLINE void sum_columns(const WindowRange& w, int y, int x0, int x1) {
  const int left = x0 - w.radius, right = x1 + w.radius;
  const int from = left < 0 ? 0 : left, to = right > w.width ? w.width : right;
  const int top = y < w.radius ? 0 : y - w.radius, bottom = y + w.radius < w.height ? y + w.radius + 1 : w.height;
  const int kinds = w.without_center ? 4 : 2;
  for (int k = 0; k < kinds; ++k) {
    for (int u = left; u < from; ++u) w.sums[k][u - left] = 0;
    for (int u = to; u < right; ++u) w.sums[k][u - left] = 0;
  }
  for (int u = from; u < to; u += kDoubles) {
    VD first = hn::Zero(dd), second = first, first_hole = first, second_hole = first;
    for (int v = top; v < bottom; ++v) {
      const VD value = hn::PromoteTo(dd, hn::LoadU(half, w.plane + v * w.pitch + u));
      first = first + value;
      second = hn::MulAdd(value, value, second);
      if (!w.without_center || v == y) continue;
      first_hole = first_hole + value;
      second_hole = hn::MulAdd(value, value, second_hole);
    }
    const VD sums[4] = {first, second, first_hole, second_hole};
    for (int k = 0; k < kinds; ++k)
      hn::BlendedStore(sums[k], hn::FirstN(dd, std::size_t(to - u)), dd, w.sums[k] + u - left);
  }
}

// Fills low and high for pixels [x0, x1) of row y, from index 0. In double, for the variance is a difference of sums.
// These are taken over columns and then along the row in one order, so a pixel's range depends on its window alone. A
// centre that does not count is left out of them: to subtract a firefly again would cost the digits that its neighbours
// are in.
HWY_INLINE void ranges(const WindowRange& w, int y, int x0, int x1) {
  sum_columns(w, y, x0, x1);
  const int rows = (y + w.radius < w.height ? y + w.radius + 1 : w.height) - (y < w.radius ? 0 : y - w.radius);
  const VD least = hn::Set(dd, double(w.least_spread)), k = hn::Set(dd, double(w.k)), one = hn::Set(dd, 1.0);
  // Away from the sides all windows have one size, and one division will do.
  const VD inverse_inside = one / hn::Set(dd, double((2 * w.radius + 1) * rows - (w.without_center ? 1 : 0)));
  for (int i = 0; i < x1 - x0; i += kDoubles) {
    VD first = hn::Zero(dd), second = first;
    for (int t = 0; t <= 2 * w.radius; ++t) {
      const int hole = w.without_center && t == w.radius ? 2 : 0;
      first = first + hn::LoadU(dd, w.sums[hole] + i + t);
      second = second + hn::LoadU(dd, w.sums[hole + 1] + i + t);
    }
    const VD x = hn::Iota(dd, double(x0 + i)), r = hn::Set(dd, double(w.radius));
    const VD columns = hn::Min(x + r + one, hn::Set(dd, double(w.width))) - hn::Max(x - r, hn::Zero(dd));
    const VD n = columns * hn::Set(dd, double(rows)) - hn::Set(dd, w.without_center ? 1.0 : 0.0);
    const bool inside = x0 + i >= w.radius && x0 + i + kDoubles + w.radius <= w.width;
    const VD inverse = inside ? inverse_inside : one / hn::Max(n, one), mean = first * inverse;
    const VD variance = hn::NegMulAdd(mean, mean, second * inverse);
    const VD sigma = hn::Sqrt(hn::Max(variance, hn::Zero(dd)));
    const VD reach = hn::IfThenElse(n < hn::Set(dd, 2.0), hn::Set(dd, w.without_center ? HUGE_VAL : 0.0),
                                    k * hn::Max(sigma, least * hn::Abs(mean)));
    hn::StoreU(hn::DemoteTo(half, mean - reach), half, w.low + i);
    hn::StoreU(hn::DemoteTo(half, mean + reach), half, w.high + i);
  }
}

HWY_INLINE V into_range(V v, const WindowRange& w, int i) {
  return hn::Min(hn::Max(v, load(w.low + i)), load(w.high + i));
}

QUELL_SIMD_END
#endif
