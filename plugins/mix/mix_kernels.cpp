// Mixes rows.
#include "mix/mix_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

void mix(int x0, int x1, const float* image, const float* other, const float* share, float* out) {
  const V none = all(0.0f), one = all(1.0f);
  for (int x = x0; x < x1; x += kLanes) {
    const V a = load(image + x), s = hn::Min(hn::Max(load(share + x), none), one);
    // As a step away from the first, which so stays what it is to the bit where the share is 0 or both are equal.
    store(mul_add(s, load(other + x) - a, a), out + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(mix);

void mix_row(int x0, int x1, const float* image, const float* other, const float* share, float* out) {
  HWY_DYNAMIC_DISPATCH(mix)(x0, x1, image, other, share, out);
}

}  // namespace quell
#endif
