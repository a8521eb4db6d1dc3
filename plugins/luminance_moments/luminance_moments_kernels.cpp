// Luminances of a row, and their squares.
#include "luminance_moments/luminance_moments_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

void moments(int x0, int x1, const float* const* image, float* first, float* second) {
  for (int x = x0; x < x1; x += kLanes) {
    const V l = luminance(load(image[0] + x), load(image[1] + x), load(image[2] + x));
    store(l, first + x, x1 - x);
    store(l * l, second + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(moments);

void moments_row(int x0, int x1, const float* const image[3], float* first, float* second) {
  HWY_DYNAMIC_DISPATCH(moments)(x0, x1, image, first, second);
}

}  // namespace quell
#endif
