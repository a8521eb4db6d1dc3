// Averages history by validated taps, a vector of pixels at a time.
#include "reproject/reproject_kernels.h"

#include "disocclusion/history.h"

QUELL_SIMD_BEGIN

void warp(const TapsRow& row, int x0, int x1, const quell_image& from, const quell_image& to) {
  for (int x = x0; x < x1; x += kLanes) {
    const int count = x1 - x;
    const Support s = support_at(row, x, count);
    const TapReader taps(s, row);
    for (int c = 0; c < from.channels; ++c) {
      const float* plane = from.plane[c];
      float* out = to.plane[c] + row.y * to.pitch;
      V sum = s.weight[0] * taps.read(0, plane);
      for (int k = 1; k < 4; ++k) sum = mul_add(s.weight[k], taps.read(k, plane), sum);
      store(sum, out + x, count);
      each_scattered(s, x, count, [&](int u) HWY_ATTR { out[u] = mean_around(row, plane, u); });
    }
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(warp);

void warp_row(const TapsRow& row, int x0, int x1, const quell_image& from, const quell_image& to) {
  HWY_DYNAMIC_DISPATCH(warp)(row, x0, x1, from, to);
}

}  // namespace quell
#endif
