// Exponents of a falloff of the distance between pixels over any number of channels, taken in a space that is a
// function of each number. For *_kernels.cpp only.

#include <quell/weights.h>

#if defined(QUELL_SQUARED_DISTANCE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_SQUARED_DISTANCE_H_
#undef QUELL_SQUARED_DISTANCE_H_
#else
#define QUELL_SQUARED_DISTANCE_H_
#endif

QUELL_SIMD_BEGIN

struct Linear {
  static HWY_INLINE V of(V x) { return x; }
};
struct Log {
  static HWY_INLINE V of(V x) { return hn::CopySign(log2(hn::Abs(x) + all(1.0f)) * all(1 / kLog2E), x); }
};
struct SquareRoot {
  static HWY_INLINE V of(V x) { return hn::CopySign(hn::Sqrt(hn::Abs(x)), x); }
};

template <class F, class S>
void one_channel(const quell_run& run, const float* plane, float sigma, float* exponent) {
  const V scale = all(F::kUnitSquared / (sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V centre = S::of(p(plane));
    return [=](auto q) HWY_ATTR {
      const V difference = S::of(q(plane)) - centre;
      return F::of_square(difference * difference * scale);
    };
  });
}
template <class F, class S>
void three_channels(const quell_run& run, const float* r, const float* g, const float* b, float sigma,
                    float* exponent) {
  const V scale = all(F::kUnitSquared / (sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V pr = S::of(p(r)), pg = S::of(p(g)), pb = S::of(p(b));
    return [=](auto q) HWY_ATTR {
      const V dr = S::of(q(r)) - pr, dg = S::of(q(g)) - pg, db = S::of(q(b)) - pb;
      return F::of_square(mul_add(dr, dr, mul_add(dg, dg, db * db)) * scale);
    };
  });
}
// Any number of them: the centre is read again at each tap, for its channels need not fit into registers.
template <class F, class S>
void many_channels(const quell_run& run, const float* const* planes, int channels, float sigma, float* exponent) {
  const V scale = all(F::kUnitSquared / (sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    return [=](auto q) HWY_ATTR {
      V squared = zero();
      for (int c = 0; c < channels; ++c) {
        const V difference = S::of(q(planes[c])) - S::of(p(planes[c]));
        squared = mul_add(difference, difference, squared);
      }
      return F::of_square(squared * scale);
    };
  });
}

template <class S>
void weigh_by_distance(const quell_run& run, const float* const* planes, int channels, Falloff falloff, float sigma,
                       float* exponent) {
  if (falloff == Falloff::gaussian) {
    // Its exponent is a sum over channels, so channel after channel may be added.
    quell_run rest = run;
    int c = 0;
    for (; c + 3 <= channels; c += 3, rest.store = 0)
      three_channels<falloffs::Gaussian, S>(rest, planes[c], planes[c + 1], planes[c + 2], sigma, exponent);
    for (; c < channels; ++c, rest.store = 0) one_channel<falloffs::Gaussian, S>(rest, planes[c], sigma, exponent);
    return;
  }
  with_falloff(falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    channels == 1   ? one_channel<Fall, S>(run, planes[0], sigma, exponent)
    : channels == 3 ? three_channels<Fall, S>(run, planes[0], planes[1], planes[2], sigma, exponent)
                    : many_channels<Fall, S>(run, planes, channels, sigma, exponent);
  });
}

QUELL_SIMD_END
#endif
