// Divides rows of radiance by clipped albedo.
#include "demodulate/demodulate_kernels.h"

#include "demodulate/divisor.h"

QUELL_SIMD_BEGIN

void divide(const demodulation::Rule& rule, int x0, int x1, const float* const* image, const float* const* albedo,
            float* const* out) {
  for (int x = x0; x < x1; x += kLanes) {
    V by[3];
    divisors(rule, albedo, x, by);
    for (int c = 0; c < 3; ++c) store(load(image[c] + x) / by[c], out[c] + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(divide);

void demodulate_row(const demodulation::Rule& rule, int x0, int x1, const float* const image[3],
                    const float* const albedo[3], float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(divide)(rule, x0, x1, image, albedo, out);
}

}  // namespace quell
#endif
