// The loops over a row, once for each SIMD target. Nothing here contracts a * b + c, so all targets give the same bits.
#include "core/sequence/conversion_kernels.h"

#include <quell/types.h>

#include <quell/simd.h>

QUELL_SIMD_BEGIN

using Size = std::size_t;
using One = hn::CappedTag<float, 1>;

// Calls step(tag, i) for a vector of floats from number i on, and with a tag of one lane for those that remain.
template <class Step>
HWY_INLINE void steps(Size n, Step step) {
  Size i = 0;
  for (; i + Size(kLanes) <= n; i += Size(kLanes)) step(d, i);
  for (; i < n; ++i) step(One(), i);
}

bool clean(const float* row, Size n, bool signs_allowed) {
  using Bits = hn::RebindToSigned<F>;
  const auto all_but_sign = hn::Set(Bits(), 0x7FFFFFFF);
  auto largest = hn::Zero(Bits()), any = hn::Zero(Bits());
  Size i = 0;
  for (; i + Size(kLanes) <= n; i += Size(kLanes)) {
    const auto bits = hn::BitCast(Bits(), hn::LoadU(d, row + i));
    largest = hn::Max(largest, hn::And(bits, all_but_sign));
    any = hn::Or(any, bits);
  }
  if (i < n) {
    HWY_ALIGN float rest[kLanes] = {};
    for (Size k = 0; i + k < n; ++k) rest[k] = row[i + k];
    const auto bits = hn::BitCast(Bits(), hn::Load(d, rest));
    largest = hn::Max(largest, hn::And(bits, all_but_sign));
    any = hn::Or(any, bits);
  }
  const bool finite = hn::AllTrue(Bits(), hn::Lt(largest, hn::Set(Bits(), 0x7F800000)));
  return finite && (signs_allowed || hn::AllFalse(Bits(), hn::Lt(any, hn::Zero(Bits()))));
}

template <class D>
HWY_INLINE hn::Vec<D> inverse_length(D wide, hn::Vec<D> x, hn::Vec<D> y, hn::Vec<D> z, hn::Vec<D> shortest) {
  const auto squares = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
  const auto length = hn::Sqrt(squares);
  return hn::IfThenZeroElse(hn::Lt(length, shortest), hn::Div(hn::Set(wide, 1.0), length));
}

void unit(float* const* xyz, Size n, double shortest) {
  float *px = xyz[0], *py = xyz[1], *pz = xyz[2];
  const auto vectors = [=](auto narrow, Size i) HWY_ATTR {
    const hn::Rebind<double, decltype(narrow)> wide;
    const auto load_wide = [=](const float* p) HWY_ATTR { return hn::PromoteTo(wide, hn::LoadU(narrow, p + i)); };
    const auto x = load_wide(px), y = load_wide(py), z = load_wide(pz);
    const auto by = inverse_length(wide, x, y, z, hn::Set(wide, shortest));
    hn::StoreU(hn::DemoteTo(narrow, hn::Mul(x, by)), narrow, px + i);
    hn::StoreU(hn::DemoteTo(narrow, hn::Mul(y, by)), narrow, py + i);
    hn::StoreU(hn::DemoteTo(narrow, hn::Mul(z, by)), narrow, pz + i);
  };
  // As many floats as a vector holds doubles.
  constexpr Size kWide = HWY_TARGET == HWY_SCALAR ? 1 : Size(kLanes) / 2;
  Size i = 0;
  for (; i + kWide <= n; i += kWide) vectors(hn::CappedTag<float, kWide>(), i);
  for (; i < n; ++i) vectors(One(), i);
}

Size far(float* depth, Size n, float from) {
  Size none = 0;
  steps(n, [&, depth, from](auto f, Size i) HWY_ATTR {
    const auto v = hn::LoadU(f, depth + i);
    // Comparisons with NaN are false, and so it is not in between.
    const auto kept =
        hn::And(hn::Lt(v, hn::Set(f, from)), hn::And(hn::Gt(v, hn::Set(f, -HUGE_VALF)), hn::Ne(v, hn::Zero(f))));
    none += hn::CountTrue(f, hn::IsNaN(v));
    hn::StoreU(hn::IfThenElse(kept, v, hn::Set(f, kFar)), f, depth + i);
  });
  return none;
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(clean);
HWY_EXPORT(unit);
HWY_EXPORT(far);

bool all_clean(const float* row, std::size_t n, bool signs_allowed) {
  return HWY_DYNAMIC_DISPATCH(clean)(row, n, signs_allowed);
}
void to_unit_length(float* const xyz[3], std::size_t n, double shortest) {
  HWY_DYNAMIC_DISPATCH(unit)(xyz, n, shortest);
}
std::size_t far_where_nothing_is(float* depth, std::size_t n, float from) {
  return HWY_DYNAMIC_DISPATCH(far)(depth, n, from);
}

}  // namespace quell
#endif
