// Compares the means of two frames around each pixel: sums down the columns of the window, then along the row, always
// from the first to the last, so that a pixel's sums depend on its window alone.
#include "anti_lag/anti_lag_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// Three rows side by side in memory: of this frame's luminance, of history's, and of the sum of their squares.
struct Rows {
  float* first;
  std::ptrdiff_t plane;
  float* of(int p) const { return first + p * plane; }
};

void luminances(const AntiLag& a, int x0, int x1, int y, const Rows& out) {
  for (int x = x0; x < x1; x += kLanes) {
    const std::ptrdiff_t at = y * a.pitch + x;
    const V now = luminance(load(a.now[0] + at), load(a.now[1] + at), load(a.now[2] + at));
    const V past = luminance(load(a.then[0] + at), load(a.then[1] + at), load(a.then[2] + at));
    const V then = hn::IfThenElse(load(a.count + at) > all(1.0f), past, now);
    store(now, out.of(0) + x - x0, x1 - x);
    store(then, out.of(1) + x - x0, x1 - x);
    store(mul_add(now, now, then * then), out.of(2) + x - x0, x1 - x);
  }
}

void sum_columns(const Rows& from, std::ptrdiff_t next, int rows, int n, const Rows& to) {
  for (int i = 0; i < n; i += kLanes)
    for (int p = 0; p < 3; ++p) {
      V sum = zero();
      for (int v = 0; v < rows; ++v) sum = sum + load(from.of(p) + v * next + i);
      store(sum, to.of(p) + i, n - i);
    }
}

// `sums` begins with the column at x0 - radius.
void shorten_row(const AntiLag& a, int x0, int x1, int y, int rows, const Rows& sums, float* out) {
  const V reach = all(float(a.radius)), width = all(float(a.width));
  for (int x = x0; x < x1; x += kLanes) {
    V now = zero(), then = zero(), squares = zero();
    for (int t = 0; t <= 2 * a.radius; ++t) {
      now = now + load(sums.of(0) + x - x0 + t);
      then = then + load(sums.of(1) + x - x0 + t);
      squares = squares + load(sums.of(2) + x - x0 + t);
    }
    const V here = lane_numbers() + all(float(x));
    const V columns = hn::Min(here + reach + all(1.0f), width) - hn::Max(here - reach, zero());
    const V each = all(1.0f) / (columns * all(float(rows)));
    const V m = now * each, h = then * each;
    const V variances = hn::Max(squares * each - mul_add(m, m, h * h), zero());
    const V noise = all(a.deviations) * hn::Sqrt(variances * each), level = hn::Max(hn::Max(m, h), all(1e-20f));
    const V t = all(a.strength) * hn::Max(hn::Abs(m - h) - noise, zero()) / level;
    const V count = load(a.count + y * a.pitch + x), keep = all(1.0f) - hn::Min(t, all(1.0f));
    store(hn::IfThenElse(count > all(1.0f), hn::Max(count * keep, all(1.0f)), count), out + y * a.pitch + x, x1 - x);
  }
}

void shorten(const AntiLag& a, const quell_tile& tile, std::vector<float>& memory, float* out) {
  const int r = a.radius, left = tile.x0 - r, right = tile.x1 + r;
  const int from = left < 0 ? 0 : left, to = right < a.width ? right : a.width;
  const int top = tile.y0 < r ? 0 : tile.y0 - r, bottom = tile.y1 + r < a.height ? tile.y1 + r : a.height;
  const std::ptrdiff_t row = right - left + kLanes;  // a vector may be read that begins with the last column
  memory.assign(std::size_t(3 * row * (bottom - top + 1)), 0.0f);
  const Rows lines{memory.data() + 3 * row, row};
  for (int y = top; y < bottom; ++y) luminances(a, from, to, y, {lines.first + 3 * row * (y - top), row});
  // Columns outside the image stay 0.
  const Rows sums{memory.data(), row}, inside{sums.first + from - left, row};
  for (int y = tile.y0; y < tile.y1; ++y) {
    const int first = y < r ? 0 : y - r, last = y + r < a.height ? y + r + 1 : a.height;
    sum_columns({lines.first + 3 * row * (first - top), row}, 3 * row, last - first, to - from, inside);
    shorten_row(a, tile.x0, tile.x1, y, last - first, sums, out);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(shorten);
void anti_lag_tile(const AntiLag& a, const quell_tile& tile, std::vector<float>& memory, float* out) {
  HWY_DYNAMIC_DISPATCH(shorten)(a, tile, memory, out);
}

}  // namespace quell
#endif
