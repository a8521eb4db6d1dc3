// Exponents of a falloff of the distance between pixels over any number of channels. For *_kernels.cpp only.

#include <quell/weights.h>

#if defined(QUELL_SQUARED_DISTANCE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUELL_SQUARED_DISTANCE_H_
#undef QUELL_SQUARED_DISTANCE_H_
#else
#define QUELL_SQUARED_DISTANCE_H_
#endif

QUELL_SIMD_BEGIN

template <class F>
void one_channel(const quell_run& run, const float* plane, float sigma, float* exponent) {
  const V scale = all(F::kUnitSquared / (sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V centre = p(plane);
    return [=](auto q) HWY_ATTR {
      const V difference = q(plane) - centre;
      return F::of_square(difference * difference * scale);
    };
  });
}
template <class F>
void three_channels(const quell_run& run, const float* r, const float* g, const float* b, float sigma,
                    float* exponent) {
  const V scale = all(F::kUnitSquared / (sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V pr = p(r), pg = p(g), pb = p(b);
    return [=](auto q) HWY_ATTR {
      const V dr = q(r) - pr, dg = q(g) - pg, db = q(b) - pb;
      return F::of_square(mul_add(dr, dr, mul_add(dg, dg, db * db)) * scale);
    };
  });
}
// Any number of them: the centre is read again at each tap, for its channels need not fit into registers.
template <class F>
void many_channels(const quell_run& run, const float* const* planes, int channels, float sigma, float* exponent) {
  const V scale = all(F::kUnitSquared / (sigma * sigma));
  each(run, exponent, [=](auto p) HWY_ATTR {
    return [=](auto q) HWY_ATTR {
      V squared = zero();
      for (int c = 0; c < channels; ++c) {
        const V difference = q(planes[c]) - p(planes[c]);
        squared = mul_add(difference, difference, squared);
      }
      return F::of_square(squared * scale);
    };
  });
}

inline void weigh_by_distance(const quell_run& run, const float* const* planes, int channels, Falloff falloff,
                              float sigma, float* exponent) {
  if (falloff == Falloff::gaussian) {
    // Its exponent is a sum over channels, so channel after channel may be added.
    quell_run rest = run;
    int c = 0;
    for (; c + 3 <= channels; c += 3, rest.store = 0)
      three_channels<falloffs::Gaussian>(rest, planes[c], planes[c + 1], planes[c + 2], sigma, exponent);
    for (; c < channels; ++c, rest.store = 0) one_channel<falloffs::Gaussian>(rest, planes[c], sigma, exponent);
    return;
  }
  with_falloff(falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    channels == 1   ? one_channel<Fall>(run, planes[0], sigma, exponent)
    : channels == 3 ? three_channels<Fall>(run, planes[0], planes[1], planes[2], sigma, exponent)
                    : many_channels<Fall>(run, planes, channels, sigma, exponent);
  });
}

QUELL_SIMD_END
#endif
