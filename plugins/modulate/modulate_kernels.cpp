// Multiplies rows of irradiance by clipped albedo.
#include "modulate/modulate_kernels.h"

#include "demodulate/divisor.h"

QUELL_SIMD_BEGIN

void multiply(const demodulation::Rule& rule, int x0, int x1, const float* const* image, const float* const* albedo,
              const float* const* emission, float* const* out) {
  for (int x = x0; x < x1; x += kLanes) {
    V by[3];
    divisors(rule, albedo, x, by);
    if (rule.mode == demodulation::Mode::asymmetric)
      for (int c = 0; c < 3; ++c) by[c] = load(albedo[c] + x);
    for (int c = 0; c < 3; ++c) {
      const V more = emission[0] ? load(emission[c] + x) : zero();
      store(mul_add(load(image[c] + x), by[c], more), out[c] + x, x1 - x);
    }
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(multiply);

void modulate_row(const demodulation::Rule& rule, int x0, int x1, const float* const image[3],
                  const float* const albedo[3], const float* const emission[3], float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(multiply)(rule, x0, x1, image, albedo, emission, out);
}

}  // namespace quell
#endif
