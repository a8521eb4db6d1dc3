// The spaces that boxes live in: YCoCg, and a scale that compresses highlights. For *_kernels.cpp only.

#include <quell/simd.h>

#if defined(QUELL_BOX_SPACE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_BOX_SPACE_H_
#undef QUELL_BOX_SPACE_H_
#else
#define QUELL_BOX_SPACE_H_
#endif

QUELL_SIMD_BEGIN

// ±log(1 + |x|), and back. What is near 0 keeps its absolute error: a few 1e-8.
HWY_INLINE V compressed(V x) { return hn::CopySign(log2(hn::Abs(x) + all(1.0f)) * all(1 / kLog2E), x); }
HWY_INLINE V expanded(V x) {
  // 2^126 is as far as exp2 goes.
  const V e = hn::Min(hn::Abs(x) * all(kLog2E), all(126.0f));
  return hn::CopySign(hn::Max(exp2(e) - all(1.0f), zero()), x);
}

// Y = (R + 2G + B)/4, Co = (R - B)/2, Cg = (2G - R - B)/4; and back.
HWY_INLINE void to_ycocg(V* v) {
  const V quarter = all(0.25f), sum = v[0] + v[2], green = all(0.5f) * v[1];
  const V y = mul_add(quarter, sum, green), cg = hn::NegMulAdd(quarter, sum, green);
  v[1] = all(0.5f) * (v[0] - v[2]);
  v[0] = y, v[2] = cg;
}
HWY_INLINE void from_ycocg(V* v) {
  const V rest = v[0] - v[2], green = v[0] + v[2];
  v[0] = rest + v[1];
  v[2] = rest - v[1];
  v[1] = green;
}

QUELL_SIMD_END
#endif
