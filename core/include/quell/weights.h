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
//
// A node that measures a distance leaves the exponent to a falloff that the user chooses:
//
//   with_falloff(falloff, [&](auto f) HWY_ATTR {  // once a run, with the type of the falloff
//     using Fall = decltype(f);
//     const V k = all(Fall::kUnit / sigma);
//     each(run, exponent, [=](auto p) HWY_ATTR {
//       const V z = p(depth);
//       return [=](auto q) HWY_ATTR { return Fall::of(hn::Abs(q(depth) - z) * k); };
//     });
//   });

#include <quell/simd.h>

#if defined(QUELL_WEIGHTS_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_WEIGHTS_H_
#undef QUELL_WEIGHTS_H_
#else
#define QUELL_WEIGHTS_H_
#endif

#include <quell/abi.h>
#include <quell/falloff.h>

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

// The functions of Falloff as exponents. A node multiplies its distance with kUnit / sigma, or the square of it with
// kUnitSquared / sigma², and so pays for the constants once a run: of(D · kUnit / sigma) is of_square of the other. The
// exponent is 0 where the distance is 0 and +inf where the weight is 0; of +inf, too.
namespace falloffs {

// -log2 of a weight from 0 to 1; of what rounding leaves below 0, +inf.
HWY_INLINE V exponent_of(V weight) { return zero() - log2(hn::Max(weight, zero())); }

struct Gaussian {
  static constexpr float kUnitSquared = kLog2E / 2, kUnit = 0.849321800f;
  static HWY_INLINE V of(V x) { return x * x; }
  static HWY_INLINE V of_square(V x2) { return x2; }
};
struct Exponential {
  static constexpr float kUnit = kLog2E, kUnitSquared = kUnit * kUnit;
  static HWY_INLINE V of(V x) { return x; }
  static HWY_INLINE V of_square(V x2) { return hn::Sqrt(x2); }
};
struct Cosine {
  static constexpr float kUnit = 1, kUnitSquared = 1;
  static HWY_INLINE V of(V x) { return of_square(x * x); }
  static HWY_INLINE V of_square(V x2) {
    const V v = hn::Min(x2, all(1.0f));  // the series of cos(πx / 2) to x¹², whose rest is below 1e-8
    V p = mul_add(v, all(4.7108748e-7f), all(-2.5202042e-5f));
    p = mul_add(p, v, all(9.1926027e-4f));
    p = mul_add(p, v, all(-2.0863481e-2f));
    p = mul_add(p, v, all(2.5366951e-1f));
    p = mul_add(p, v, all(-1.2337006f));
    return exponent_of(mul_add(p, v, all(1.0f)));
  }
};
struct Tent {
  static constexpr float kUnit = 1, kUnitSquared = 1;
  static HWY_INLINE V of(V x) { return exponent_of(all(1.0f) - x); }
  static HWY_INLINE V of_square(V x2) { return of(hn::Sqrt(x2)); }
};
struct Smoothstep {
  static constexpr float kUnit = 1, kUnitSquared = 1;
  static HWY_INLINE V of(V x) {
    const V t = hn::Min(x, all(1.0f));
    return exponent_of(hn::NegMulAdd(t * t, hn::NegMulAdd(all(2.0f), t, all(3.0f)), all(1.0f)));
  }
  static HWY_INLINE V of_square(V x2) { return of(hn::Sqrt(x2)); }
};
struct Rational {
  static constexpr float kUnit = 3, kUnitSquared = 9;
  static HWY_INLINE V of(V x) { return log2(mul_add(x, x + all(1.0f), all(1.0f))); }
  static HWY_INLINE V of_square(V x2) { return log2(x2 + hn::Sqrt(x2) + all(1.0f)); }
};
struct Step {
  static constexpr float kUnit = 1, kUnitSquared = 1;
  static HWY_INLINE V of(V x) { return hn::IfThenElse(x < all(1.0f), zero(), all(HUGE_VALF)); }
  static HWY_INLINE V of_square(V x2) { return of(x2); }
};

}  // namespace falloffs

// Calls visit with a value of the falloff's type.
template <class Visit>
HWY_INLINE void with_falloff(Falloff f, Visit visit) {
  switch (f) {
    case Falloff::gaussian:
      return visit(falloffs::Gaussian{});
    case Falloff::exponential:
      return visit(falloffs::Exponential{});
    case Falloff::cosine:
      return visit(falloffs::Cosine{});
    case Falloff::tent:
      return visit(falloffs::Tent{});
    case Falloff::smoothstep:
      return visit(falloffs::Smoothstep{});
    case Falloff::rational:
      return visit(falloffs::Rational{});
    case Falloff::step:
      return visit(falloffs::Step{});
  }
}

// 1 / x to a few units in the last place, by a Newton step from the machine's estimate: x positive, at least 1e-37.
HWY_INLINE V reciprocal(V x) {
  const V r = hn::ApproximateReciprocal(x);
  return r * hn::NegMulAdd(x, r, all(2.0f));
}

QUELL_SIMD_END
#endif
