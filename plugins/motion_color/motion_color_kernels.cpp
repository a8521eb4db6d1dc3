// Directions to hues without an angle.
#include "motion_color/motion_color_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// Of the directions of red, green and blue: 0, a third and two thirds of a turn.
constexpr float kCos[3] = {1.0f, -0.5f, -0.5f}, kSin[3] = {0.0f, 0.8660254f, -0.8660254f};
constexpr float kKnown = 1e5f;

void wheel(float longest, int x0, int x1, const float* dx, const float* dy, float* const* out) {
  for (int x = x0; x < x1; x += kLanes) {
    const V u = load(dx + x), v = load(dy + x);
    const V length = hn::Sqrt(mul_add(u, u, v * v));
    const V per = all(1.0f) / hn::Max(length, all(1e-20f));
    const V bright = hn::Min(length / all(longest), all(1.0f));
    const M known = length <= all(kKnown);
    for (int c = 0; c < 3; ++c) {
      const V along = mul_add(u, all(kCos[c]), v * all(kSin[c])) * per;
      const V hue = hn::Min(hn::Max(along + all(0.5f), zero()), all(1.0f));
      store(hn::IfThenElse(known, bright * hue, all(0.5f)), out[c] + x, x1 - x);
    }
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(wheel);

void motion_color_row(float longest, int x0, int x1, const float* dx, const float* dy, float* const out[3]) {
  HWY_DYNAMIC_DISPATCH(wheel)(longest, x0, x1, dx, dy, out);
}

}  // namespace quell
#endif
