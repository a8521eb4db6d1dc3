// Tone curves over rows.
#include "tonemap/tonemap_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

// Its square is a float, and no display tells it from infinity.
constexpr float kMost = 65536.0f;

// The sRGB curve of x in [0, 1].
HWY_INLINE V srgb(V x) {
  const V power = exp2(log2(hn::Max(x, all(0.0031308f))) * all(1.0f / 2.4f));
  const V curve = mul_add(power, all(1.055f), all(-0.055f));
  return hn::IfThenElse(x <= all(0.0031308f), x * all(12.92f), curve);
}

template <class Curve>
HWY_INLINE void each_pixel(int x0, int x1, const float* const* image, float* const* out, bool encode, Curve curve) {
  for (int x = x0; x < x1; x += kLanes) {
    V v[3];
    for (int c = 0; c < 3; ++c) v[c] = hn::Min(hn::Max(load(image[c] + x), zero()), all(kMost));
    curve(v);
    for (int c = 0; c < 3; ++c) {
      const V shown = hn::Min(v[c], all(1.0f));
      store(encode ? srgb(shown) : shown, out[c] + x, x1 - x);
    }
  }
}

void rational(const tone::Rational& r, int x0, int x1, const float* const* image, float* const* out, bool encode) {
  each_pixel(x0, x1, image, out, encode, [&](V v[3]) HWY_ATTR {
    for (int c = 0; c < 3; ++c) {
      const V x = v[c];
      const V over = mul_add(mul_add(x, all(r.over_square), all(r.over_linear)), x, all(r.over_one));
      v[c] = mul_add(x, all(r.square), all(r.linear)) * x / over;
    }
  });
}

void reinhard(int x0, int x1, const float* const* image, float* const* out, bool encode) {
  each_pixel(x0, x1, image, out, encode, [](V v[3]) HWY_ATTR {
    const V over = all(1.0f) + luminance(v[0], v[1], v[2]);
    for (int c = 0; c < 3; ++c) v[c] = v[c] / over;
  });
}

void clamp_only(int x0, int x1, const float* const* image, float* const* out, bool encode) {
  each_pixel(x0, x1, image, out, encode, [](V*) HWY_ATTR {});
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(rational);
HWY_EXPORT(reinhard);
HWY_EXPORT(clamp_only);

void tonemap_row(tone::Operator curve, tone::Encoding encoding, int x0, int x1, const float* const image[3],
                 float* const out[3]) {
  const bool encode = encoding == tone::Encoding::srgb;
  switch (curve) {
    case tone::Operator::clamp:
      return HWY_DYNAMIC_DISPATCH(clamp_only)(x0, x1, image, out, encode);
    case tone::Operator::reinhard:
      return HWY_DYNAMIC_DISPATCH(reinhard)(x0, x1, image, out, encode);
    case tone::Operator::aces:
      return HWY_DYNAMIC_DISPATCH(rational)(tone::kAces, x0, x1, image, out, encode);
    case tone::Operator::hable: {
      constexpr auto curve_of_hable = tone::hable();
      return HWY_DYNAMIC_DISPATCH(rational)(curve_of_hable, x0, x1, image, out, encode);
    }
  }
}

}  // namespace quell
#endif
