// Parts rows of radiance into what surfaces reflect and what enters no kernel.
#include "split_emitters/split_emitters_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

constexpr float kFarDepth = 1e30f;
// Cycles writes an emitter's radiance into its albedo pass, so there the two are equal but for the rounding of the
// file.
constexpr float kSame = 1e-3f;

HWY_INLINE M none() { return hn::FirstN(d, 0); }

HWY_INLINE M misses(const SplitRow& r, int x) {
  M miss = none();
  if (r.normal[0]) {
    const M along_x = load(r.normal[0] + x) == zero(), along_y = load(r.normal[1] + x) == zero();
    miss = hn::And(hn::And(along_x, along_y), load(r.normal[2] + x) == zero());
  }
  if (r.depth) miss = hn::Or(miss, load(r.depth + x) >= all(0.5f * kFarDepth));
  return miss;
}

HWY_INLINE M emitters(const SplitRow& r, int x) {
  if (r.emission[0])
    return hn::Or(hn::Or(load(r.emission[0] + x) > zero(), load(r.emission[1] + x) > zero()),
                  load(r.emission[2] + x) > zero());
  if (!r.albedo[0]) return none();
  const V a[3] = {load(r.albedo[0] + x), load(r.albedo[1] + x), load(r.albedo[2] + x)};
  const V brightest = hn::Max(hn::Max(a[0], a[1]), a[2]), apart = brightest * all(kSame);
  M emits = brightest > all(1.0f);
  for (int c = 0; c < 3; ++c) emits = hn::And(emits, hn::Abs(load(r.color[c] + x) - a[c]) <= apart);
  return emits;
}

void split(const SplitRow& r, int x0, int x1) {
  for (int x = x0; x < x1; x += kLanes) {
    const int count = x1 - x;
    const M aside = r.keep ? none() : hn::Or(misses(r, x), emitters(r, x));
    for (int c = 0; c < 3; ++c) {
      const V color = load(r.color[c] + x);
      // What is below zero after the subtraction goes with the emission, so that the sum stays exact.
      const V rest = r.emission[0] ? hn::Max(color - load(r.emission[c] + x), zero()) : color;
      const V lit = hn::IfThenZeroElse(aside, rest);
      store(lit, r.lit[c] + x, count);
      store(color - lit, r.aside[c] + x, count);
      if (r.normal[0]) store(hn::IfThenZeroElse(aside, load(r.normal[c] + x)), r.normal_out[c] + x, count);
    }
    if (r.depth) store(hn::IfThenElse(aside, all(kFarDepth), load(r.depth + x)), r.depth_out + x, count);
  }
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(split);

void split_emitters(const SplitRow& row, int x0, int x1) { HWY_DYNAMIC_DISPATCH(split)(row, x0, x1); }

}  // namespace quell
#endif
