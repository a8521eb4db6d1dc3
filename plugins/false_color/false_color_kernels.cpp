// Numbers to places on a colour map, and places to colours.
#include "false_color/false_color_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// The fit of degree 5 of the turbo map, one row a channel, lowest power first.
constexpr float kTurbo[3][6] = {{0.13572138f, 4.61539260f, -42.66032258f, 132.13108234f, -152.94239396f, 59.28637943f},
                                {0.09140261f, 2.19418839f, 4.84296658f, -14.18503333f, 4.27729857f, 2.82956604f},
                                {0.10667330f, 12.64194608f, -60.58204836f, 110.36276771f, -89.90310912f, 27.34824973f}};
constexpr float kMiss = 0.5e30f;

HWY_INLINE V clamp01(V v) { return hn::Min(hn::Max(v, zero()), all(1.0f)); }

void color(const ColorScale& scale, float stops, int x0, int x1, const float* in, float* const* out) {
  const bool grey = scale.map == ColorMap::grey;
  const V low = all(scale.logarithmic ? scale.low - stops : scale.low);
  const V per = all(1.0f / (scale.high - scale.low));
  for (int x = x0; x < x1; x += kLanes) {
    const V v = load(in + x);
    // The logarithm of what has none is minus infinity, the first colour.
    const V place = clamp01(((scale.logarithmic ? log2(v) : v) - low) * per);
    const M shown = v < all(kMiss);
    for (int c = 0; c < 3; ++c) {
      V p = place;
      if (!grey) {
        p = all(kTurbo[c][5]);
        for (int i = 4; i >= 0; --i) p = mul_add(p, place, all(kTurbo[c][i]));
        p = clamp01(p);
      }
      store(hn::IfThenElseZero(shown, p), out[c] + x, x1 - x);
    }
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(color);

void color_row(const ColorScale& scale, float stops, int x0, int x1, const float* in, float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(color)(scale, stops, x0, x1, in, out);
}

}  // namespace quell
#endif
