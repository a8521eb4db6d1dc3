// Separable blur of one tile, row by row.
#include "gaussian/gaussian_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// Gives Σ kernel[k] · from[k · stride + i] to put(i, sums) for n numbers and the rest of a step. Four vectors a step
// share each weight.
template <class Store>
HWY_INLINE void convolve(const float* kernel, int taps, const float* from, std::ptrdiff_t stride, int n, Store put) {
  for (int i = 0; i < n; i += 4 * kLanes) {
    V s0 = zero(), s1 = zero(), s2 = zero(), s3 = zero();
    const float* p = from + i;
    for (int k = 0; k < taps; ++k, p += stride) {
      const V w = all(kernel[k]);
      s0 = mul_add(w, load(p), s0);
      s1 = mul_add(w, load(p + kLanes), s1);
      s2 = mul_add(w, load(p + 2 * kLanes), s2);
      s3 = mul_add(w, load(p + 3 * kLanes), s3);
    }
    put(i, s0), put(i + kLanes, s1), put(i + 2 * kLanes, s2), put(i + 3 * kLanes, s3);
  }
}

void blur(Blur& b, const quell_tile& tile, const quell_image& in, const quell_image& out) {
  const int r = b.radius, first_column = tile.x0 - r < 0 ? 0 : tile.x0 - r;
  const int end_column = tile.x1 + r > in.width ? in.width : tile.x1 + r;
  float* const row = b.row.data();  // its number i is column tile.x0 - r + i
  float* const inside = row + (first_column - (tile.x0 - r));
  float* const end = row + (tile.x1 - tile.x0) + 2 * r;
  for (int channel = 0; channel < in.channels; ++channel)
    for (int y = tile.y0; y < tile.y1; ++y) {
      const int first = y - r < 0 ? 0 : y - r, last = y + r >= in.height ? in.height - 1 : y + r;
      const V along = all(b.along[std::size_t(y - tile.y0)]);
      convolve(b.kernel.data() + (first - (y - r)), last - first + 1,
               in.plane[channel] + first * in.pitch + first_column, in.pitch, end_column - first_column,
               [=](int i, V sum) HWY_ATTR { store(sum * along, inside + i); });
      for (float* p = inside + (end_column - first_column); p < end; ++p) *p = 0;
      const float* across = b.across.data();
      float* const to = out.plane[channel] + y * out.pitch + tile.x0;
      const int n = tile.x1 - tile.x0;
      convolve(b.kernel.data(), 2 * r + 1, row, 1, n, [=](int i, V sum) HWY_ATTR {
        if (i < n) store(sum * load(across + i), to + i, n - i);
      });
    }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(blur);
void gaussian_tile(Blur& b, const quell_tile& tile, const quell_image& in, const quell_image& out) {
  HWY_DYNAMIC_DISPATCH(blur)(b, tile, in, out);
}

}  // namespace quell
#endif
