// What the hand-fused opponents are written with. They need AVX-512, so without it this is empty.
#pragma once

#ifdef __AVX512F__
#include <immintrin.h>

namespace quell::bench {

using V = __m512;
inline constexpr float kLog2E = 1.44269504f;

inline V all(float f) { return _mm512_set1_ps(f); }
inline V load(const float* p) { return _mm512_loadu_ps(p); }
inline V fma(V a, V b, V c) { return _mm512_fmadd_ps(a, b, c); }
inline V luminance(V r, V g, V b) { return fma(r, all(.2126f), fma(g, all(.7152f), _mm512_mul_ps(b, all(.0722f)))); }

// Relative error 3e-6.
inline V exp2(V x) {
  const V f = _mm512_reduce_ps(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);  // x - floor(x)
  V p = fma(f, all(0.013534167f), all(0.052011464f));
  p = fma(p, f, all(0.24144275f));
  p = fma(p, f, all(0.69300383f));
  return _mm512_scalef_ps(fma(p, f, all(1.0000026f)), x);  // times 2^floor(x)
}

}  // namespace quell::bench
#endif
