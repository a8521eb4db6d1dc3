// The functions of quell/simd.h against the standard library in double precision, on every target.
#include "tests/support/each_target.h"

#include <algorithm>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/core/simd_test.cpp"
#include <quell/simd.h>

QUELL_SIMD_BEGIN
template <class Function>
HWY_INLINE void map(const float* in, float* out, int n, Function function) {
  for (int i = 0; i < n; i += kLanes) store(function(load(in + i)), out + i, n - i);
}
void exp2_of(const float* in, float* out, int n) {
  map(in, out, n, [](V x) HWY_ATTR { return exp2(x); });
}
void exp2_or_zero_of(const float* in, float* out, int n) {
  map(in, out, n, [](V x) HWY_ATTR { return exp2_or_zero(x); });
}
void log2_of(const float* in, float* out, int n) {
  map(in, out, n, [](V x) HWY_ATTR { return log2(x); });
}
void exp_of(const float* in, float* out, int n) {
  map(in, out, n, [](V x) HWY_ATTR { return exp(x); });
}
void luminance_of(const float* in, float* out, int n) {
  map(in, out, n, [](V x) HWY_ATTR { return luminance(x, x * all(2.0f), x * all(3.0f)); });
}
int lanes_now() { return kLanes; }
QUELL_SIMD_END

#if HWY_ONCE
namespace quell {

HWY_EXPORT(exp2_of);
HWY_EXPORT(exp2_or_zero_of);
HWY_EXPORT(log2_of);
HWY_EXPORT(exp_of);
HWY_EXPORT(luminance_of);
HWY_EXPORT(lanes_now);

namespace {

constexpr int kPadding = 64;  // loads of whole vectors may pass the end

std::vector<float> ramp(float from, float to, int n) {
  std::vector<float> values(std::size_t(n + kPadding), from);
  for (int i = 0; i < n; ++i) values[std::size_t(i)] = from + (to - from) * float(i) / float(n - 1);
  return values;
}

constexpr int kCount = 10007;

TEST(Simd, Exp2) {
  const auto x = ramp(-126.0f, 127.0f, kCount);
  test::for_each_target([&] {
    std::vector<float> y(x.size());
    HWY_DYNAMIC_DISPATCH(exp2_of)(x.data(), y.data(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double expected = std::exp2(double(x[i]));
      ASSERT_NEAR(y[i] / expected, 1.0, 6e-7) << x[i];
    }
  });
}

TEST(Simd, Exp2OfWholeNumbersIsExact) {
  std::vector<float> x, y(253 + kPadding);
  for (int i = -126; i <= 126; ++i) x.push_back(float(i));
  x.resize(y.size());
  test::for_each_target([&] {
    HWY_DYNAMIC_DISPATCH(exp2_of)(x.data(), y.data(), 253);
    for (std::size_t i = 0; i < 253; ++i) ASSERT_EQ(y[i], std::exp2(x[i]));
  });
}

TEST(Simd, Exp2OrZero) {
  const auto x = ramp(-125.99f, 127.0f, kCount);
  test::for_each_target([&] {
    std::vector<float> y(x.size());
    HWY_DYNAMIC_DISPATCH(exp2_or_zero_of)(x.data(), y.data(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) ASSERT_NEAR(y[i] / std::exp2(double(x[i])), 1.0, 6e-7) << x[i];
  });
}

TEST(Simd, Exp2OrZeroOfWholeNumbersIsExactAndOfTheRestZero) {
  const float inf = HUGE_VALF, nan = std::nanf("");
  const std::vector<float> whole{0, -1, -2, -17, -125, 1, 5, 127};
  const std::vector<float> nothing{-inf, -1e30f, -1000, -201, -160, -151, nan, -nan};
  test::for_each_target([&] {
    std::vector<float> x(whole), y(kPadding * 2);
    x.resize(y.size());
    HWY_DYNAMIC_DISPATCH(exp2_or_zero_of)(x.data(), y.data(), int(whole.size()));
    for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_EQ(y[i], std::exp2(whole[i])) << whole[i];
    std::copy(nothing.begin(), nothing.end(), x.begin());
    HWY_DYNAMIC_DISPATCH(exp2_or_zero_of)(x.data(), y.data(), int(nothing.size()));
    for (std::size_t i = 0; i < nothing.size(); ++i) ASSERT_EQ(y[i], 0.0f) << nothing[i];
  });
}

TEST(Simd, Exp) {
  const auto x = ramp(-87.0f, 88.0f, kCount);
  test::for_each_target([&] {
    std::vector<float> y(x.size());
    HWY_DYNAMIC_DISPATCH(exp_of)(x.data(), y.data(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) ASSERT_NEAR(y[i] / std::exp(double(x[i])), 1.0, 6e-6) << x[i];
  });
}

TEST(Simd, Log2) {
  for (const auto& x : {ramp(1e-6f, 4.0f, kCount), ramp(0.9f, 1.1f, kCount), ramp(1.0f, 1e30f, kCount)})
    test::for_each_target([&] {
      std::vector<float> y(x.size());
      HWY_DYNAMIC_DISPATCH(log2_of)(x.data(), y.data(), kCount);
      for (std::size_t i = 0; i < kCount; ++i) {
        const double expected = std::log2(double(x[i]));
        ASSERT_NEAR(y[i], expected, 1e-7 + 3e-7 * std::abs(expected)) << x[i];
      }
    });
}

TEST(Simd, Log2OfZeroIsMinusInfinity) {
  std::vector<float> x(kPadding, 0.0f), y(kPadding);
  test::for_each_target([&] {
    HWY_DYNAMIC_DISPATCH(log2_of)(x.data(), y.data(), 1);
    EXPECT_EQ(y[0], -HUGE_VALF);
  });
}

TEST(Simd, Luminance) {
  const auto x = ramp(0.0f, 100.0f, kCount);
  test::for_each_target([&] {
    std::vector<float> y(x.size());
    HWY_DYNAMIC_DISPATCH(luminance_of)(x.data(), y.data(), kCount);
    for (std::size_t i = 0; i < kCount; ++i)
      ASSERT_NEAR(y[i], double(x[i]) * (0.2126 + 2 * 0.7152 + 3 * 0.0722), 3e-7 * x[i] + 1e-30);
  });
}

TEST(Simd, StoreLeavesLanesBeyondTheCount) {
  const std::vector<float> x(128, 2.0f);
  test::for_each_target([&] {
    for (int n = 1; n <= 33; ++n) {
      std::vector<float> y(128, -1.0f);
      HWY_DYNAMIC_DISPATCH(exp2_of)(x.data(), y.data(), n);
      for (int i = 0; i < 128; ++i) ASSERT_EQ(y[std::size_t(i)], i < n ? 4.0f : -1.0f) << n;
    }
  });
}

TEST(Simd, PinningATargetTakesEffect) {
  std::vector<int> lanes;
  test::for_each_target([&] { lanes.push_back(HWY_DYNAMIC_DISPATCH(lanes_now)()); });
  const std::vector<int> expected = {1, 4, 8, 16};
  ASSERT_FALSE(lanes.empty());
  for (std::size_t i = 0; i < lanes.size(); ++i) EXPECT_EQ(lanes[i], expected[i]);
}

}  // namespace
}  // namespace quell
#endif
