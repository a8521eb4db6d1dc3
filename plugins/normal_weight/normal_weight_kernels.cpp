// Exponents of normal_weight, two vectors of pixels a step.
#include "normal_weight/normal_weight_kernels.h"

#include <quell/weights.h>

#include <type_traits>

QUELL_SIMD_BEGIN

// u = 1 - n·n', not below 0. A miss has no normal, so it seems to be a right angle away.
struct ByCosine {
  static constexpr float kMiss = 1;
  static HWY_INLINE V u(V x, V y, V z, V qx, V qy, V qz) {
    return hn::Max(hn::NegMulAdd(qx, x, hn::NegMulAdd(qy, y, hn::NegMulAdd(qz, z, all(1.0f)))), zero());
  }
};
// The same as |n - n'|² / 2, which is 0 where the normals are equal: a falloff of the distance itself, which is the
// root of it, would make much of the rounding that the cosine leaves.
struct ByDifference {
  static constexpr float kMiss = 0.5f;
  static HWY_INLINE V u(V x, V y, V z, V qx, V qy, V qz) {
    const V dx = qx - x, dy = qy - y, dz = qz - z;
    return mul_add(dx, dx, mul_add(dy, dy, dz * dz)) * all(0.5f);
  }
};

template <class By, class Exponent>
HWY_INLINE void weigh_surfaces(const quell_run& run, NormalPlanes n, float* exponent, Exponent of) {
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V x = p(n.x), y = p(n.y), z = p(n.z);
    return [=](auto q) HWY_ATTR { return of(By::u(x, y, z, q(n.x), q(n.y), q(n.z))); };
  });
}
template <class By, class Exponent>
HWY_INLINE void weigh_all(const quell_run& run, NormalPlanes n, float* exponent, Exponent of) {
  each(run, exponent, [=](auto p) HWY_ATTR {
    const V x = p(n.x), y = p(n.y), z = p(n.z);
    const V miss = hn::VecFromMask(d, all_zero(x, y, z));
    return [=](auto q) HWY_ATTR {
      const V qx = q(n.x), qy = q(n.y), qz = q(n.z);
      const M here = hn::MaskFromVec(miss), there = all_zero(qx, qy, qz);
      // Told apart by u, not by its exponent, so that what the compiler makes of the latter is as above, to the bit.
      const V surface = By::u(x, y, z, qx, qy, qz);
      const V one_miss = hn::IfThenElse(hn::Xor(here, there), all(HUGE_VALF), surface);
      return of(hn::IfThenElse(hn::And(here, there), zero(), one_miss));
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

// Exponents as a function of u. Where a miss seems to be far enough away for no weight, misses must be told from
// surfaces only where the centre is one, which a segment mostly has none of.
template <class By, class Exponent>
HWY_INLINE void weigh(const quell_run& run, NormalPlanes n, float* exponent, Exponent of) {
  constexpr float kNoWeight = 126;
  const bool never = hn::GetLane(of(all(By::kMiss))) >= kNoWeight;
  never && !has_miss(run, n) ? weigh_surfaces<By>(run, n, exponent, of) : weigh_all<By>(run, n, exponent, of);
}

// -log2 (1 - u)^power. A high power needs no logarithm: -ln(1 - u) = u + u²/2 + u³/3 + …, and where the rest of the
// series counts the weight is as good as nothing.
void series(const quell_run& run, NormalPlanes n, float power, float* exponent) {
  const V c1 = all(power * kLog2E), c2 = all(power * kLog2E / 2), c3 = all(power * kLog2E / 3);
  weigh<ByCosine>(run, n, exponent, [=](V u) HWY_ATTR { return mul_add(mul_add(u, c3, c2), u, c1) * u; });
}
void logarithm(const quell_run& run, NormalPlanes n, float power, float* exponent) {
  const V minus_power = all(-power);
  weigh<ByCosine>(run, n, exponent, [=](V u) HWY_ATTR { return log2(hn::Max(all(1.0f) - u, zero())) * minus_power; });
}

// The squared angle needs neither arc-cosine nor root: acos²(1 - u) / u is smooth on [0, 1]; minimax polynomial, 1e-7.
HWY_INLINE V squared_angle(V u) {
  const V v = hn::Min(u, all(1.0f));
  V p = mul_add(v, all(0.009217675825f), all(-0.01059838758f));
  p = mul_add(p, v, all(0.02171450236f));
  p = mul_add(p, v, all(0.02409457386f));
  p = mul_add(p, v, all(0.08969117939f));
  p = mul_add(p, v, all(0.3332802896f));
  p = mul_add(p, v, all(2.000000567f));
  // What only a miss can be away is farther than a right angle.
  return hn::Max(u - all(1.0f), p * v);
}
void angle(const quell_run& run, NormalPlanes n, Falloff falloff, float sigma, float* exponent) {
  with_falloff(falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    const V scale = all(Fall::kUnitSquared / (sigma * sigma));
    const auto of = [=](V u) HWY_ATTR { return Fall::of_square(squared_angle(u) * scale); };
    // To the gaussian it is the square that counts, so the cheaper one will do.
    if constexpr (std::is_same_v<Fall, falloffs::Gaussian>)
      weigh<ByCosine>(run, n, exponent, of);
    else
      weigh<ByDifference>(run, n, exponent, of);
  });
}
void difference(const quell_run& run, NormalPlanes n, Falloff falloff, float sigma, float* exponent) {
  with_falloff(falloff, [&](auto f) HWY_ATTR {
    using Fall = decltype(f);
    const V scale = all(2 * Fall::kUnitSquared / (sigma * sigma));
    weigh<ByDifference>(run, n, exponent, [=](V u) HWY_ATTR { return Fall::of_square(u * scale); });
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(series);
HWY_EXPORT(logarithm);
HWY_EXPORT(angle);
HWY_EXPORT(difference);

void normal_weigh_power(const quell_run& run, NormalPlanes n, float power, float* exponent) {
  // From here on the series keeps within 1e-5 of the true weight, and a miss (u = 1) beside a surface within the
  // exponents that count for nothing.
  constexpr float kSeriesFrom = 48.0f;
  power >= kSeriesFrom ? HWY_DYNAMIC_DISPATCH(series)(run, n, power, exponent)
                       : HWY_DYNAMIC_DISPATCH(logarithm)(run, n, power, exponent);
}
void normal_weigh_angle(const quell_run& run, NormalPlanes n, Falloff falloff, float sigma, float* exponent) {
  HWY_DYNAMIC_DISPATCH(angle)(run, n, falloff, sigma, exponent);
}
void normal_weigh_difference(const quell_run& run, NormalPlanes n, Falloff falloff, float sigma, float* exponent) {
  HWY_DYNAMIC_DISPATCH(difference)(run, n, falloff, sigma, exponent);
}

}  // namespace quell
#endif
