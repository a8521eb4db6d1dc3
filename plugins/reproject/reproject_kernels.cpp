// Averages history by validated taps, a vector of pixels at a time.
#include "reproject/reproject_kernels.h"

#include "disocclusion/history.h"

QUELL_SIMD_BEGIN

// Four weights: those of the taps, or 1 for the largest of them. Of equals the last counts, as where a position halfway
// between two pixels falls into the second.
template <WarpFilter kFilter>
HWY_INLINE void pick(V* weight) {
  if constexpr (kFilter == WarpFilter::nearest) {
    const V largest = hn::Max(hn::Max(weight[0], weight[1]), hn::Max(weight[2], weight[3]));
    M open = largest > zero();
    for (int k = 3; k >= 0; --k) {
      const M chosen = hn::And(open, weight[k] == largest);
      open = hn::AndNot(chosen, open);
      weight[k] = hn::IfThenElseZero(chosen, all(1.0f));
    }
  }
}

// Catmull-Rom's weights of the pixels -1, 0, 1, 2 for a position t beyond pixel 0: 0, 1, 0, 0 to the bit where t is 0.
HWY_INLINE void cubic(V t, V* w) {
  const V t2 = t * t, t3 = t2 * t, half = all(0.5f);
  w[0] = hn::NegMulAdd(half, t3 + t, t2);
  w[1] = mul_add(all(1.5f), t3, hn::NegMulAdd(all(2.5f), t2, all(1.0f)));
  w[3] = half * (t3 - t2);
  w[2] = ((all(1.0f) - w[0]) - w[1]) - w[3];
}

// The cubic over the 4x4 around the positions, within the range of the inner four, to the lanes of `whole`.
HWY_INLINE void warp_cubic(const Support& s, const TapsRow& row, M whole, int x, int count, const quell_image& from,
                           const quell_image& to) {
  V along[4], across[4];
  cubic(s.at.fx, along);
  cubic(s.at.fy, across);
  with_square<-1, 4>(s.at, extent_of(row), [&](const auto& square) HWY_ATTR {
    for (int c = 0; c < from.channels; ++c) {
      V sum = zero(), least = all(HUGE_VALF), most = all(-HUGE_VALF);
      HWY_UNROLL(4)
      for (int j = 0; j < 4; ++j) {
        V line = zero();
        HWY_UNROLL(4)
        for (int i = 0; i < 4; ++i) {
          const V v = square.read(from.plane[c], i, j);
          line = mul_add(along[i], v, line);
          if ((i == 1 || i == 2) && (j == 1 || j == 2)) least = hn::Min(least, v), most = hn::Max(most, v);
        }
        sum = mul_add(across[j], line, sum);
      }
      float* out = to.plane[c] + row.y * to.pitch + x;
      store(hn::IfThenElse(whole, hn::Min(hn::Max(sum, least), most), load(out)), out, count);
    }
  });
}

template <WarpFilter kFilter>
void warp(const TapsRow& row, int x0, int x1, const quell_image& from, const quell_image& to) {
  const std::ptrdiff_t at = row.y * to.pitch;
  for (int x = x0; x < x1; x += kLanes) {
    Support s(row, x, x1 - x);
    pick<kFilter>(s.weight);
    with_taps(s, row, [&](const auto& tap) HWY_ATTR {
      for (int c = 0; c < from.channels; ++c) {
        V sum = s.weight[0] * tap(0, from.plane[c]);
        HWY_UNROLL(3)
        for (int k = 1; k < 4; ++k) sum = mul_add(s.weight[k], tap(k, from.plane[c]), sum);
        store(sum, to.plane[c] + at + x, x1 - x);
      }
    });
    if constexpr (kFilter == WarpFilter::catmull_rom) {
      const M whole = whole_footprints(s, row, x);
      if (!hn::AllFalse(d, whole)) warp_cubic(s, row, whole, x, x1 - x, from, to);
    }
    if (HWY_LIKELY(hn::AllFalse(d, s.scattered))) continue;
    const Neighbourhood around(s, row);
    for (int c = 0; c < from.channels; ++c) {
      float* out = to.plane[c] + at + x;
      store(hn::IfThenElse(s.scattered, around.mean(from.plane[c]), load(out)), out, x1 - x);
    }
  }
}

void warp_by(WarpFilter filter, const TapsRow& row, int x0, int x1, const quell_image& from, const quell_image& to) {
  filter == WarpFilter::bilinear  ? warp<WarpFilter::bilinear>(row, x0, x1, from, to)
  : filter == WarpFilter::nearest ? warp<WarpFilter::nearest>(row, x0, x1, from, to)
                                  : warp<WarpFilter::catmull_rom>(row, x0, x1, from, to);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(warp_by);

void warp_row(WarpFilter filter, const TapsRow& row, int x0, int x1, const quell_image& from, const quell_image& to) {
  HWY_DYNAMIC_DISPATCH(warp_by)(filter, row, x0, x1, from, to);
}

}  // namespace quell
#endif
