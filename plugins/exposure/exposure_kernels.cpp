// Scales rows.
#include "exposure/exposure_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

void scale(float factor, int x0, int x1, const float* in, float* out) {
  for (int x = x0; x < x1; x += kLanes)
    store(hn::Min(load(in + x) * all(factor), all(3.40282347e38f)), out + x, x1 - x);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(scale);

void scale_row(float factor, int x0, int x1, const float* in, float* out) {
  HWY_DYNAMIC_DISPATCH(scale)(factor, x0, x1, in, out);
}

}  // namespace quell
#endif
