// Divisors of a vector of pixels. For *_kernels.cpp only.

#include <quell/simd.h>

#if defined(QUELL_DIVISOR_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_DIVISOR_H_
#undef QUELL_DIVISOR_H_
#else
#define QUELL_DIVISOR_H_
#endif

#include "demodulate/rule.h"

QUELL_SIMD_BEGIN

// Below this albedo the usual demodulation takes a surface for black (Falcor's SVGF uses the same number).
constexpr float kBlack = 1e-3f;

// What the three channels of radiance are divided by.
HWY_INLINE void divisors(const demodulation::Rule& rule, const float* const* albedo, int x, V* by) {
  const V one = all(1.0f);
  const bool clip = rule.mode == demodulation::Mode::clip;
  const V floor = all(clip ? rule.floor : kBlack);
  for (int c = 0; c < 3; ++c) by[c] = hn::Max(load(albedo[c] + x), floor);
  if (clip) {
    for (int c = 0; c < 3; ++c) by[c] = hn::Min(by[c], all(rule.ceiling));
    return;
  }
  if (rule.mode == demodulation::Mode::asymmetric) return;
  const V brightest = hn::Max(hn::Max(load(albedo[0] + x), load(albedo[1] + x)), load(albedo[2] + x));
  const M plain = hn::Or(brightest<floor, brightest> one);
  for (int c = 0; c < 3; ++c) by[c] = hn::IfThenElse(plain, one, by[c]);
}

QUELL_SIMD_END
#endif
