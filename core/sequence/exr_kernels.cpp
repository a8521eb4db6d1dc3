// The loops over the bytes of an OpenEXR block, once for each SIMD target.
#include "core/sequence/exr_kernels.h"

#include <quell/simd.h>

QUELL_SIMD_BEGIN

using Byte = std::uint8_t;
using Size = std::size_t;

// A vector's worth of bytes at a time, and what remains one by one.
#if HWY_TARGET == HWY_SCALAR
constexpr Size kBytes = 0;
#else
constexpr Size kBytes = 16;
constexpr hn::FixedTag<Byte, kBytes> d16;
#endif

void sum_up(Byte* bytes, Size n) {
  if (n == 0) return;
  bytes[0] = Byte(bytes[0] + 128);  // the first is no difference: nothing was added to it
  Size i = 0;
#if HWY_TARGET != HWY_SCALAR
  const auto offset = hn::Set(d16, 128), last = hn::Set(d16, kBytes - 1);
  auto before = hn::Zero(d16);
  for (; i + kBytes <= n; i += kBytes) {
    auto v = hn::Sub(hn::LoadU(d16, bytes + i), offset);
    v = hn::Add(v, hn::ShiftLeftBytes<1>(v));
    v = hn::Add(v, hn::ShiftLeftBytes<2>(v));
    v = hn::Add(v, hn::ShiftLeftBytes<4>(v));
    v = hn::Add(v, hn::ShiftLeftBytes<8>(v));
    v = hn::Add(v, before);
    hn::StoreU(v, d16, bytes + i);
    before = hn::TableLookupBytes(v, last);
  }
#endif
  Byte total = i ? bytes[i - 1] : Byte(0);
  for (; i < n; ++i) bytes[i] = total = Byte(total + bytes[i] - 128);
}

void differ(const Byte* bytes, Byte* differences, Size n) {
  if (n == 0) return;
  differences[0] = bytes[0];
  Size i = 1;
#if HWY_TARGET != HWY_SCALAR
  const auto offset = hn::Set(d16, 128);
  for (; i + kBytes <= n; i += kBytes)
    hn::StoreU(hn::Add(hn::Sub(hn::LoadU(d16, bytes + i), hn::LoadU(d16, bytes + i - 1)), offset), d16,
               differences + i);
#endif
  for (; i < n; ++i) differences[i] = Byte(bytes[i] - bytes[i - 1] + 128);
}

void join(const Byte* even, const Byte* odd, Byte* pairs, Size n) {
  Size i = 0;
#if HWY_TARGET != HWY_SCALAR
  for (; i + kBytes <= n; i += kBytes) {
    const auto a = hn::LoadU(d16, even + i), b = hn::LoadU(d16, odd + i);
    hn::StoreU(hn::InterleaveLower(d16, a, b), d16, pairs + 2 * i);
    hn::StoreU(hn::InterleaveUpper(d16, a, b), d16, pairs + 2 * i + kBytes);
  }
#endif
  for (; i < n; ++i) pairs[2 * i] = even[i], pairs[2 * i + 1] = odd[i];
}

void split(const Byte* pairs, Byte* even, Byte* odd, Size n) {
  Size i = 0;
#if HWY_TARGET != HWY_SCALAR
  for (; i + kBytes <= n; i += kBytes) {
    const auto a = hn::LoadU(d16, pairs + 2 * i), b = hn::LoadU(d16, pairs + 2 * i + kBytes);
    hn::StoreU(hn::ConcatEven(d16, b, a), d16, even + i);
    hn::StoreU(hn::ConcatOdd(d16, b, a), d16, odd + i);
  }
#endif
  for (; i < n; ++i) even[i] = pairs[2 * i], odd[i] = pairs[2 * i + 1];
}

// Halves as words. Without F16C, Highway rounds towards zero and takes infinity for a number, so then the bits are
// moved here. `D` is a tag of floats.
template <class D>
using Words = hn::Rebind<std::uint16_t, D>;
template <class D>
using Bits = hn::Rebind<std::uint32_t, D>;

constexpr std::uint32_t kRebias = (127 - 15) << 23;  // between the exponents of float and half
constexpr float kLeastNormalHalf = 6.103515625e-05f;

template <class D>
HWY_INLINE hn::Vec<D> to_floats(D f, hn::Vec<Words<D>> words) {
#if HWY_ARCH_X86 && HWY_TARGET < HWY_SSE4
  return hn::PromoteTo(f, hn::BitCast(hn::Rebind<hwy::float16_t, D>(), words));
#else
  constexpr Bits<D> u;
  const auto bits = hn::PromoteTo(u, words);
  const auto magnitude = hn::ShiftLeft<13>(hn::And(bits, hn::Set(u, 0x7FFF)));
  const auto exponent = hn::And(magnitude, hn::Set(u, 0x7C00u << 13));
  const auto normal = hn::Add(magnitude, hn::Set(u, kRebias));
  const auto infinite = hn::Add(normal, hn::Set(u, kRebias));
  // One bit too much in the exponent stands for the 1 that a denormal number lacks; subtracting it leaves the rest.
  const auto tiny =
      hn::BitCast(u, hn::Sub(hn::BitCast(f, hn::Add(normal, hn::Set(u, 1u << 23))), hn::Set(f, kLeastNormalHalf)));
  auto out = hn::IfThenElse(hn::Eq(exponent, hn::Zero(u)), tiny, normal);
  out = hn::IfThenElse(hn::Eq(exponent, hn::Set(u, 0x7C00u << 13)), infinite, out);
  return hn::BitCast(f, hn::Or(out, hn::ShiftLeft<16>(hn::And(bits, hn::Set(u, 0x8000)))));
#endif
}

template <class D>
HWY_INLINE hn::Vec<Words<D>> to_words(D f, hn::Vec<D> v) {
  constexpr Words<D> w;
  const auto largest = hn::Set(f, 65504.0f);
  v = hn::IfThenElse(hn::Gt(hn::Abs(v), largest), hn::CopySignToAbs(largest, v), v);
#if HWY_ARCH_X86 && HWY_TARGET < HWY_SSE4
  return hn::BitCast(w, hn::DemoteTo(hn::Rebind<hwy::float16_t, D>(), v));
#else
  constexpr Bits<D> u;
  const auto bits = hn::BitCast(u, v);
  const auto sign = hn::And(bits, hn::Set(u, 0x80000000u)), magnitude = hn::Xor(bits, sign);
  // Half of the last place, less one when the last place is even: what carries over has been rounded to even.
  const auto odd = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(u, 1));
  const auto normal =
      hn::ShiftRight<13>(hn::Add(hn::Sub(magnitude, hn::Set(u, kRebias)), hn::Add(odd, hn::Set(u, 0xFFF))));
  // Adding 1/2 leaves multiples of the least half in the low bits.
  const auto tiny =
      hn::Sub(hn::BitCast(u, hn::Add(hn::BitCast(f, magnitude), hn::Set(f, 0.5f))), hn::BitCast(u, hn::Set(f, 0.5f)));
  const auto is_tiny = hn::RebindMask(u, hn::Lt(hn::BitCast(f, magnitude), hn::Set(f, kLeastNormalHalf)));
  const auto half = hn::Or(hn::IfThenElse(is_tiny, tiny, normal), hn::ShiftRight<16>(sign));
  return hn::DemoteTo(w, hn::BitCast(hn::Rebind<std::int32_t, D>(), half));
#endif
}

// Calls step(tag, i) for a vector of floats from number i on, and with a tag of one lane for those that remain.
template <class Step>
HWY_INLINE void steps(Size n, Step step) {
  Size i = 0;
  for (; i + Size(kLanes) <= n; i += Size(kLanes)) step(d, i);
  for (; i < n; ++i) step(hn::CappedTag<float, 1>(), i);
}

void promote(const Byte* halves, float* floats, Size n) {
  steps(n, [=](auto f, Size i) HWY_ATTR {
    const Words<decltype(f)> w;
    hn::StoreU(to_floats(f, hn::LoadU(w, reinterpret_cast<const std::uint16_t*>(halves + 2 * i))), f, floats + i);
  });
}

void promote_split(const Byte* low, const Byte* high, float* floats, Size n) {
  steps(n, [=](auto f, Size i) HWY_ATTR {
    const Words<decltype(f)> w;
    const hn::Rebind<Byte, decltype(f)> b;
    const auto a = hn::PromoteTo(w, hn::LoadU(b, low + i)), c = hn::PromoteTo(w, hn::LoadU(b, high + i));
    hn::StoreU(to_floats(f, hn::Or(a, hn::ShiftLeft<8>(c))), f, floats + i);
  });
}

void demote(const float* floats, std::uint16_t* halves, Size n) {
  steps(n, [=](auto f, Size i)
               HWY_ATTR { hn::StoreU(to_words(f, hn::LoadU(f, floats + i)), Words<decltype(f)>(), halves + i); });
}

void demote_split(const float* floats, Byte* low, Byte* high, Size n) {
  steps(n, [=](auto f, Size i) HWY_ATTR {
    const hn::Rebind<std::int16_t, decltype(f)> s;
    const hn::Rebind<Byte, decltype(f)> b;
    const auto words = to_words(f, hn::LoadU(f, floats + i));
    const Words<decltype(f)> w;
    hn::StoreU(hn::DemoteTo(b, hn::BitCast(s, hn::And(words, hn::Set(w, 0xFF)))), b, low + i);
    hn::StoreU(hn::DemoteTo(b, hn::BitCast(s, hn::ShiftRight<8>(words))), b, high + i);
  });
}

QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(sum_up);
HWY_EXPORT(differ);
HWY_EXPORT(join);
HWY_EXPORT(split);
HWY_EXPORT(promote);
HWY_EXPORT(promote_split);
HWY_EXPORT(demote);
HWY_EXPORT(demote_split);

void sum_differences(std::uint8_t* bytes, std::size_t n) { HWY_DYNAMIC_DISPATCH(sum_up)(bytes, n); }
void take_differences(const std::uint8_t* bytes, std::uint8_t* differences, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(differ)(bytes, differences, n);
}
void join_bytes(const std::uint8_t* even, const std::uint8_t* odd, std::uint8_t* pairs, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(join)(even, odd, pairs, n);
}
void split_bytes(const std::uint8_t* pairs, std::uint8_t* even, std::uint8_t* odd, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(split)(pairs, even, odd, n);
}
void halves_to_floats(const std::uint8_t* halves, float* floats, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(promote)(halves, floats, n);
}
void halves_to_floats(const std::uint8_t* low, const std::uint8_t* high, float* floats, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(promote_split)(low, high, floats, n);
}
void floats_to_halves(const float* floats, std::uint8_t* low, std::uint8_t* high, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(demote_split)(floats, low, high, n);
}
void floats_to_halves(const float* floats, std::uint16_t* halves, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(demote)(floats, halves, n);
}

}  // namespace quell
#endif
