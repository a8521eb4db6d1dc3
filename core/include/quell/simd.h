// One include for SIMD kernels: Highway behind one skeleton, and the few functions that every kernel wants.
//
// A source called *_kernels.cpp is compiled once per SIMD target, and the best that the machine has is chosen when it
// runs:
//
//   #include "my_node/my_node_kernels.h"  // declares quell::my_rows, called from my_node.cpp
//   #include <quell/simd.h>               // after all other includes but weights.h and gather.h
//
//   QUELL_SIMD_BEGIN  // from here to the end: one copy a target, private to this file
//   void rows(const float* in, float* out, int n) {
//     for (int i = 0; i < n; i += kLanes) store(load(in + i) * all(2.0f), out + i, n - i);
//   }
//   QUELL_SIMD_END
//
//   #if HWY_ONCE
//   namespace quell {
//   HWY_EXPORT(rows);
//   void my_rows(const float* in, float* out, int n) { HWY_DYNAMIC_DISPATCH(rows)(in, out, n); }
//   }  // namespace quell
//   #endif
//
// Inside, `hn` is Highway's namespace, V a vector of floats, M its mask and I its integers; `d` and `di` are their
// tags. Write HWY_ATTR after a lambda's parameters. Put nothing but SIMD code between BEGIN and END: what the standard
// library inlines there is compiled for the wrong machine. quell_add_plugin gives the file the name that Highway
// re-includes.

#ifndef QUELL_SIMD_TARGETS
#define QUELL_SIMD_TARGETS
#ifndef HWY_TARGET_INCLUDE
#error \
    "quell/simd.h is for *_kernels.cpp sources of quell_add_plugin; elsewhere define HWY_TARGET_INCLUDE to the file's name"
#endif
// Machines that stop at SSSE3 take the scalar code; what is left is scalar, SSE4, AVX2 and AVX-512.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (1LL << 12)
// The region below is left and entered again for each target by this include.
#include <hwy/foreach_target.h>
#endif

#include <hwy/highway.h>

#undef QUELL_SIMD_BEGIN
#undef QUELL_SIMD_END
#define QUELL_SIMD_BEGIN    \
  HWY_BEFORE_NAMESPACE();   \
  namespace quell {         \
  namespace HWY_NAMESPACE { \
  namespace {
#define QUELL_SIMD_END            \
  } /* namespace */               \
  } /* namespace HWY_NAMESPACE */ \
  } /* namespace quell */         \
  HWY_AFTER_NAMESPACE();

#if defined(QUELL_SIMD_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_SIMD_H_
#undef QUELL_SIMD_H_
#else
#define QUELL_SIMD_H_
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>

QUELL_SIMD_BEGIN
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using V = hn::Vec<F>;
using M = hn::Mask<F>;
using I = hn::Vec<hn::RebindToSigned<F>>;
constexpr F d;
constexpr hn::RebindToSigned<F> di;

constexpr float kLog2E = 1.4426950408889634f;

constexpr int kLanes = int(hn::MaxLanes(d));

HWY_INLINE V all(float value) { return hn::Set(d, value); }
HWY_INLINE V zero() { return hn::Zero(d); }
HWY_INLINE V load(const float* from) { return hn::LoadU(d, from); }
HWY_INLINE void store(V v, float* to) { hn::StoreU(v, d, to); }
// Stores the first `count` lanes, or all of them when there are more.
HWY_INLINE void store(V v, float* to, int count) {
  if (count >= kLanes)
    hn::StoreU(v, d, to);
  else
    hn::BlendedStore(v, hn::FirstN(d, std::size_t(count)), d, to);
}
// 0, 1, 2, … in the lanes.
HWY_INLINE V lane_numbers() { return hn::Iota(d, 0.0f); }

// a * b + c, rounded once where the machine can.
HWY_INLINE V mul_add(V a, V b, V c) { return hn::MulAdd(a, b, c); }

// Rec. 709 luminance of linear RGB.
HWY_INLINE V luminance(V r, V g, V b) {
  return hn::MulAdd(r, all(0.2126f), hn::MulAdd(g, all(0.7152f), b * all(0.0722f)));
}

// 2^x for x in [-126, 127]; relative error below 5e-7, exact at whole numbers. Other values, NaN among them, give
// garbage: the caller masks. The polynomial is the minimax of 2^f on [-1/2, 1/2] among those that are 1 at 0.
HWY_INLINE V exp2(V x) {
  const V magic = all(12582912.0f);  // 1.5 * 2^23: adding it leaves the nearest whole number in the low bits
  const V shifted = x + magic;
  const V f = x - (shifted - magic);
  V p = hn::MulAdd(f, all(0.001112520722f), all(0.009666282532f));
  p = hn::MulAdd(p, f, all(0.05557401409f));
  p = hn::MulAdd(p, f, all(0.2402235065f));
  p = hn::MulAdd(p, f, all(0.6931428301f));
  p = hn::MulAdd(p, f, all(1.0f));
  return hn::BitCast(d, hn::BitCast(di, p) + hn::ShiftLeft<23>(hn::BitCast(di, shifted)));
}
// 2^x for x up to 127, and 0 where it is below -126 (or about: denormals are as good as 0) or x is NaN. Same error.
HWY_INLINE V exp2_or_zero(V x) {
#if HWY_TARGET <= HWY_AVX3
  // One instruction each for the fraction and the power of two, which also take care of the range; the polynomial is
  // the minimax of 2^f on [0, 1] among those that are 1 at 0 and 2 at 1. Of a NaN the maximum is its second operand.
  const __m512 in_range = _mm512_max_ps(x.raw, _mm512_set1_ps(-200.0f));
  const V f{_mm512_reduce_ps(in_range, _MM_FROUND_TO_NEG_INF)};
  V p = hn::MulAdd(f, all(0.001879318648f), all(0.008990995096f));
  p = hn::MulAdd(p, f, all(0.05581867596f));
  p = hn::MulAdd(p, f, all(0.2401592715f));
  p = hn::MulAdd(p, f, all(0.6931517388f));
  p = hn::MulAdd(p, f, all(1.0f));
  return V{_mm512_scalef_ps(p.raw, in_range)};
#else
  return hn::IfThenElseZero(x > all(-126.0f), exp2(x));
#endif
}
// exp(x) for x in [-87, 88], by exp2; relative error below 6e-6 at the ends of the range.
HWY_INLINE V exp(V x) { return exp2(x * all(kLog2E)); }

// log2 of finite x; absolute error below 1e-7 near 1 and relative error below 3e-7 elsewhere; -inf where x is 0 (or
// denormal, or negative: the caller masks those).
HWY_INLINE V log2(V x) {
  const I bits = hn::BitCast(di, x);
  // x = m * 2^e with m in [sqrt(1/2), sqrt(2)).
  const I e = hn::ShiftRight<23>(bits - hn::Set(di, 0x3f3504f3));
  const V m = hn::BitCast(d, bits - hn::ShiftLeft<23>(e));
  // ln m = 2 atanh s, s = (m - 1) / (m + 1), |s| < 0.1716: four terms of the odd series leave 3e-8 of s.
  const V s = (m - all(1.0f)) / (m + all(1.0f));
  const V s2 = s * s;
  V p = hn::MulAdd(s2, all(2.0f / 7.0f * kLog2E), all(2.0f / 5.0f * kLog2E));
  p = hn::MulAdd(p, s2, all(2.0f / 3.0f * kLog2E));
  p = hn::MulAdd(p, s2, all(2.0f * kLog2E));
  const V log = hn::MulAdd(p, s, hn::ConvertTo(d, e));
  return hn::IfThenElse(x < all(1.17549435e-38f), all(-HUGE_VALF), log);
}
QUELL_SIMD_END
#endif
