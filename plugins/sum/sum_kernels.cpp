// Adds rows.
#include "sum/sum_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

void add(const float* a, const float* b, float* out, int x0, int x1) {
  for (int x = x0; x < x1; x += kLanes) {
    const V v = load(b + x);
    store(a ? load(a + x) + v : v, out + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(add);

void add_row(const float* a, const float* b, float* out, int x0, int x1) {
  HWY_DYNAMIC_DISPATCH(add)(a, b, out, x0, x1);
}

}  // namespace quell
#endif
