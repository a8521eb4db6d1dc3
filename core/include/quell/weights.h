// Weight nodes as lambdas: what an edge-stopping function says of one vector of pixels, and the loops around it.
//
// For *_kernels.cpp only. A kernel is a function of a centre that returns a function of a neighbour that returns the
// exponent: log2 units, not negative, +inf for "never"; the weight of the tap is 2 to the minus the sum of all nodes'.
//
//   each(run, exponent, [=](auto p) HWY_ATTR {    // once for each vector of centre pixels: what is the same for all
//   taps
//     const V z = p(depth);                       // depth is a plane of the node's input
//     return [=](auto q) HWY_ATTR { return hn::Abs(q(depth) - z) * k; };
//   });
//
// each_pair puts a function of the offset between them, which is run once for a tap and its mirror image: for what
// depends on |o| alone. Capture by value: what is captured by reference is loaded again at each tap.

#include <quell/simd.h>

#if defined(QUELL_WEIGHTS_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_WEIGHTS_H_
#undef QUELL_WEIGHTS_H_
#else
#define QUELL_WEIGHTS_H_
#endif

#include <quell/abi.h>

QUELL_SIMD_BEGIN

// A vector of pixels: reads any plane of the node's inputs there.
struct Pixels {
  std::ptrdiff_t at;
  HWY_INLINE V operator()(const float* plane) const { return load(plane + at); }
};

// From the centre to the neighbour, pixels. Of a mirrored pair, the first tap's.
struct Offset {
  V dx, dy;
};

template <bool kStore>
HWY_INLINE void put(V e, float* to) {
  store(kStore ? e : load(to) + e, to);
}

// Two vectors of centres a step: half the loop overhead and twice the independent chains of one. Flattened, for the
// lambdas must be part of the loop.
template <bool kStore, class Weight>
HWY_FLATTEN void each_tap(const quell_run& run, float* exponent, Weight weight) {
  for (int i = 0; i < run.n; i += 2 * kLanes) {
    const std::ptrdiff_t at = run.at + i;
    const auto a = weight(Pixels{at}), b = weight(Pixels{at + kLanes});
    float* to = exponent + i;
    for (const quell_tap *t = run.tap, *end = t + run.taps; t != end; ++t, to += run.row) {
      put<kStore>(a(Pixels{at + t->offset}), to);
      put<kStore>(b(Pixels{at + t->offset + kLanes}), to + kLanes);
    }
  }
}
template <bool kStore, class Weight>
HWY_FLATTEN void each_mirrored(const quell_run& run, float* exponent, Weight weight) {
  const int together = run.paired ? 2 : 1;
  for (int i = 0; i < run.n; i += 2 * kLanes) {
    const std::ptrdiff_t at = run.at + i;
    const auto a = weight(Pixels{at}), b = weight(Pixels{at + kLanes});
    float* to = exponent + i;
    for (const quell_tap *t = run.tap, *end = t + run.taps; t < end; t += together) {
      const Offset o{hn::ConvertTo(d, hn::Set(di, t->dx)), hn::ConvertTo(d, hn::Set(di, t->dy))};
      const auto a_pair = a(o), b_pair = b(o);
      for (int k = 0; k < together; ++k, to += run.row) {
        put<kStore>(a_pair(Pixels{at + t[k].offset}), to);
        put<kStore>(b_pair(Pixels{at + t[k].offset + kLanes}), to + kLanes);
      }
    }
  }
}

template <class Weight>
HWY_INLINE void each(const quell_run& run, float* exponent, Weight weight) {
  run.store ? each_tap<true>(run, exponent, weight) : each_tap<false>(run, exponent, weight);
}
template <class Weight>
HWY_INLINE void each_pair(const quell_run& run, float* exponent, Weight weight) {
  run.store ? each_mirrored<true>(run, exponent, weight) : each_mirrored<false>(run, exponent, weight);
}

// True in lanes where a vector that is zero for misses is zero.
HWY_INLINE M all_zero(V x, V y, V z) { return hn::Abs(hn::Or3(x, y, z)) == zero(); }

// 1 / x to a few units in the last place, by a Newton step from the machine's estimate: x positive, at least 1e-37.
HWY_INLINE V reciprocal(V x) {
  const V r = hn::ApproximateReciprocal(x);
  return r * hn::NegMulAdd(x, r, all(2.0f));
}

QUELL_SIMD_END
#endif
