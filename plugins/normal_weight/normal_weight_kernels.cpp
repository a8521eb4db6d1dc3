// Exponents of normal_weight, two vectors of pixels a step.
#include "normal_weight/normal_weight_kernels.h"

#include <quell/weights.h>

QUELL_SIMD_BEGIN

// Large enough to make any of the falloffs below exceed every exponent that counts, small enough to be cubed.
constexpr float kNever = 1e8f;

HWY_INLINE V one_minus_dot(V x, V y, V z, V qx, V qy, V qz) {
  return hn::NegMulAdd(qx, x, hn::NegMulAdd(qy, y, hn::NegMulAdd(qz, z, all(1.0f))));
}

// u = 1 - n·n', not below 0. A miss has no normal, so n·n' is 0 and u is 1 between a miss and a surface as between two
// misses. The last two must be told apart only where the centre is a miss, which a segment mostly has none of.
template <class Falloff>
HWY_INLINE void weigh_surfaces(const quell_run& run, NormalPlanes n, float* exponent, Falloff falloff) {
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V x = p(n.x), y = p(n.y), z = p(n.z);
    return [=](auto q) HWY_ATTR { return falloff(hn::Max(one_minus_dot(x, y, z, q(n.x), q(n.y), q(n.z)), zero())); };
  });
}
template <class Falloff>
HWY_INLINE void weigh_all(const quell_run& run, NormalPlanes n, float* exponent, Falloff falloff) {
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V x = p(n.x), y = p(n.y), z = p(n.z);
    const V miss = hn::VecFromMask(d, all_zero(x, y, z));
    return [=](auto q) HWY_ATTR {
      const V qx = q(n.x), qy = q(n.y), qz = q(n.z);
      const V surface = hn::Max(one_minus_dot(x, y, z, qx, qy, qz), zero());
      const M here = hn::MaskFromVec(miss), there = all_zero(qx, qy, qz);
      const V one_miss = hn::IfThenElse(hn::Xor(here, there), all(kNever), surface);
      return falloff(hn::IfThenElse(hn::And(here, there), zero(), one_miss));
    };
  });
}
inline bool has_miss(const quell_run& run, NormalPlanes n) {
  for (int i = 0; i < run.n; i += kLanes) {
    const Pixels p{run.at + i};
    const M miss = hn::And(all_zero(p(n.x), p(n.y), p(n.z)), hn::FirstN(d, std::size_t(run.n - i)));
    if (!hn::AllFalse(d, miss)) return true;
  }
  return false;
}

// -log2 (1 - u)^power. A high power needs no logarithm: -ln(1 - u) = u + u²/2 + u³/3 + …, and where the rest of the
// series counts the weight is as good as nothing.
void series(const quell_run& run, NormalPlanes n, float power, float* exponent) {
  const V c1 = all(power * kLog2E), c2 = all(power * kLog2E / 2), c3 = all(power * kLog2E / 3);
  const auto falloff = [=](V u) HWY_ATTR { return mul_add(mul_add(u, c3, c2), u, c1) * u; };
  has_miss(run, n) ? weigh_all(run, n, exponent, falloff) : weigh_surfaces(run, n, exponent, falloff);
}
void logarithm(const quell_run& run, NormalPlanes n, float power, float* exponent) {
  const V minus_power = all(-power);
  const auto falloff = [=](V u) HWY_ATTR { return log2(hn::Max(all(1.0f) - u, zero())) * minus_power; };
  has_miss(run, n) ? weigh_all(run, n, exponent, falloff) : weigh_surfaces(run, n, exponent, falloff);
}
// The squared angle needs neither arc-cosine nor root: acos²(1 - u) / u is smooth on [0, 1]; minimax polynomial, 1e-7.
void angle(const quell_run& run, NormalPlanes n, float sigma, float* exponent) {
  const V scale = all(kLog2E / (2 * sigma * sigma));
  const auto falloff = [=](V u) HWY_ATTR {
    const V v = hn::Min(u, all(1.0f));
    V p = mul_add(v, all(0.009217675825f), all(-0.01059838758f));
    p = mul_add(p, v, all(0.02171450236f));
    p = mul_add(p, v, all(0.02409457386f));
    p = mul_add(p, v, all(0.08969117939f));
    p = mul_add(p, v, all(0.3332802896f));
    p = mul_add(p, v, all(2.000000567f));
    // What only a miss can be away is farther than a right angle.
    return hn::Max(u - all(1.0f), p * v) * scale;
  };
  // A right angle, as a miss seems to be away, exceeds the exponents that count only for a small sigma; else misses are
  // looked for at each tap.
  constexpr float kRightAngleIsNever = 0.118f;
  sigma < kRightAngleIsNever && !has_miss(run, n) ? weigh_surfaces(run, n, exponent, falloff)
                                                  : weigh_all(run, n, exponent, falloff);
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(series);
HWY_EXPORT(logarithm);
HWY_EXPORT(angle);

void normal_weigh_power(const quell_run& run, NormalPlanes n, float power, float* exponent) {
  // From here on the series keeps within 1e-5 of the true weight, and a miss (u = 1) beside a surface within the
  // exponents that count for nothing.
  constexpr float kSeriesFrom = 48.0f;
  power >= kSeriesFrom ? HWY_DYNAMIC_DISPATCH(series)(run, n, power, exponent)
                       : HWY_DYNAMIC_DISPATCH(logarithm)(run, n, power, exponent);
}
void normal_weigh_angle(const quell_run& run, NormalPlanes n, float sigma, float* exponent) {
  HWY_DYNAMIC_DISPATCH(angle)(run, n, sigma, exponent);
}

}  // namespace quell
#endif
