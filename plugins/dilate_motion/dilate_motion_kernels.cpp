// Looks for the motion that counts, over windows that the image border cuts off.
#include "dilate_motion/dilate_motion_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// What decides: the largest wins.
HWY_INLINE V claim(const MotionField& f, DilateBy by, std::ptrdiff_t at) {
  if (by == DilateBy::depth) return zero() - load(f.depth + at);
  const V x = load(f.motion[0] + at), y = load(f.motion[1] + at);
  return mul_add(x, x, y * y);
}

void dilate(const MotionField& f, DilateBy by, int radius, int y, int x0, int x1, float* const* out) {
  const int top = y < radius ? 0 : y - radius, bottom = y + radius < f.height ? y + radius : f.height - 1;
  for (int x = x0; x < x1; x += kLanes) {
    const std::ptrdiff_t here = y * f.pitch + x;
    V best = claim(f, by, here), mx = load(f.motion[0] + here), my = load(f.motion[1] + here);
    const V column = lane_numbers() + all(float(x));
    for (int v = top; v <= bottom; ++v)
      for (int dx = -radius; dx <= radius; ++dx) {
        const std::ptrdiff_t at = v * f.pitch + x + dx;
        const V u = column + all(float(dx)), other = claim(f, by, at);
        const M inside = hn::And(u >= zero(), u < all(float(f.width)));
        const M wins = hn::And(inside, other > best);
        best = hn::IfThenElse(wins, other, best);
        mx = hn::IfThenElse(wins, load(f.motion[0] + at), mx);
        my = hn::IfThenElse(wins, load(f.motion[1] + at), my);
      }
    store(mx, out[0] + x, x1 - x);
    store(my, out[1] + x, x1 - x);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(dilate);

void dilate_row(const MotionField& f, DilateBy by, int radius, int y, int x0, int x1, float* const out[2]) {
  HWY_DYNAMIC_DISPATCH(dilate)(f, by, radius, y, x0, x1, out);
}

}  // namespace quell
#endif
