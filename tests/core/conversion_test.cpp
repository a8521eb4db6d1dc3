// The vector code of conversions against plain double precision, on every SIMD target.
#include "core/sequence/conversion_kernels.h"
#include "tests/support/each_target.h"

#include <quell/types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace quell {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

std::vector<float> numbers(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-2.0f, 2.0f);
  std::vector<float> out(n);
  for (auto& v : out) v = value(random);
  return out;
}

TEST(ConversionKernels, OneUncleanNumberAnywhereIsFound) {
  test::for_each_target([] {
    for (const std::size_t n : {1, 3, 16, 17, 40}) {
      auto row = numbers(n, 1);
      for (auto& v : row) v = std::abs(v);
      row[0] = std::numeric_limits<float>::max();
      EXPECT_TRUE(all_clean(row.data(), n, false));
      for (std::size_t at = 0; at < n; ++at) {
        const float before = row[at];
        for (const float bad : {kNaN, -kNaN, kInf, -kInf}) {
          row[at] = bad;
          ASSERT_FALSE(all_clean(row.data(), n, true)) << n << ' ' << at;
        }
        row[at] = -1e-30f;
        ASSERT_FALSE(all_clean(row.data(), n, false)) << n << ' ' << at;
        ASSERT_TRUE(all_clean(row.data(), n, true));
        row[at] = before;
      }
    }
    EXPECT_TRUE(all_clean(nullptr, 0, false));
  });
}

TEST(ConversionKernels, VectorsGetLengthOne) {
  test::for_each_target([] {
    for (const std::size_t n : {1, 5, 16, 33}) {
      std::vector<float> in[3] = {numbers(n, 1), numbers(n, 2), numbers(n, 3)};
      for (auto& plane : in) plane[n / 2] = 1e-9f;
      auto out = std::vector{in[0], in[1], in[2]};
      float* const xyz[] = {out[0].data(), out[1].data(), out[2].data()};
      to_unit_length(xyz, n, 1e-6);
      for (std::size_t i = 0; i < n; ++i) {
        const double x = in[0][i], y = in[1][i], z = in[2][i], length = std::sqrt(x * x + y * y + z * z);
        for (std::size_t c = 0; c < 3; ++c) {
          const double expected = length < 1e-6 ? 0.0 : double(in[c][i]) / length;
          // Half a unit in the last place of a float, and a little for two roundings of doubles.
          ASSERT_NEAR(out[c][i], expected, std::abs(expected) * 0x1p-24 * 1.0001) << n << ' ' << i;
        }
      }
    }
  });
}

TEST(ConversionKernels, NothingIsFarAway) {
  test::for_each_target([] {
    for (std::size_t n = 1; n < 40; ++n) {
      auto depth = numbers(n, 4);
      const auto before = depth;
      const float misses[] = {0.0f, -0.0f, 1e10f, 2e10f, kInf, -kInf, kNaN};
      std::size_t nans = 0;
      for (std::size_t i = 0; i < n; i += 3) depth[i] = misses[(i + n) % 7], nans += std::isnan(depth[i]);
      EXPECT_EQ(far_where_nothing_is(depth.data(), n, 1e10f), nans);
      for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(depth[i], i % 3 ? before[i] : kFar) << n << ' ' << i;
    }
  });
}

}  // namespace
}  // namespace quell
