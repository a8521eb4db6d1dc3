// Averages history by validated taps, a vector of pixels at a time.
#include "reproject/reproject_kernels.h"

#include "disocclusion/history.h"

QUELL_SIMD_BEGIN

void warp(const TapsRow& row, int x0, int x1, const quell_image& from, const quell_image& to) {
  const std::ptrdiff_t at = row.y * to.pitch;
  for (int x = x0; x < x1; x += kLanes) {
    const Support s(row, x, x1 - x);
    with_taps(s, row, [&](const auto& tap) HWY_ATTR {
      for (int c = 0; c < from.channels; ++c) {
        V sum = s.weight[0] * tap(0, from.plane[c]);
        HWY_UNROLL(3)
        for (int k = 1; k < 4; ++k) sum = mul_add(s.weight[k], tap(k, from.plane[c]), sum);
        store(sum, to.plane[c] + at + x, x1 - x);
      }
    });
    if (HWY_LIKELY(hn::AllFalse(d, s.scattered))) continue;
    const Neighbourhood around(s, row);
    for (int c = 0; c < from.channels; ++c) {
      float* out = to.plane[c] + at + x;
      store(hn::IfThenElse(s.scattered, around.mean(from.plane[c]), load(out)), out, x1 - x);
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
