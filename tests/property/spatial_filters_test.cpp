// What every spatial filter of images keeps, whatever it does: found from the tables alone, so that a new one is held
// to this by being there. A spatial filter gives back an image like the one that it takes and needs nothing else.
#include "tests/support/settings.h"
#include "tests/support/typical_input.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 97, kHeight = 31;

// The input that is filtered, or nullptr: the first output passes an image of its own type, and no other image is
// required.
const quell_port* filtered(const NodeType& type) {
  if (type.is_weight() || type.outputs().empty()) return nullptr;
  const auto& out = type.outputs()[0];
  if (out.passes < 0 || (out.type != QUELL_ANY && out.type != QUELL_RADIANCE)) return nullptr;
  const auto& in = type.inputs()[std::size_t(out.passes)];
  if (in.type != out.type) return nullptr;
  for (const auto& other : type.inputs())
    if (&other != &in && other.type != QUELL_WEIGHT && !(other.flags & (QUELL_OPTIONAL | QUELL_LIST))) return nullptr;
  return &in;
}

std::vector<std::string> filters() {
  std::vector<std::string> list;
  for (const auto* type : registry().all())
    if (filtered(*type)) list.emplace_back(type->name());
  return list;
}

// Light with fireflies and black pixels; no two pixels alike.
Image picture(std::uint32_t seed) {
  auto image = noise_image(kWidth, kHeight, 3, seed, 0.01f, 1.0f);
  const auto dice = noise_image(kWidth, kHeight, 1, seed + 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(c, x, y) *= dice.at(0, x, y) > 0.97f ? 300.0f : dice.at(0, x, y) < 0.1f ? 1e-3f : 1.0f;
  return image;
}

class SpatialFilter : public testing::TestWithParam<std::string> {
 protected:
  const NodeType& type() const { return *registry().find(GetParam()); }
  Image run(const Image& image, const Setting& setting) const {
    return std::move(node_of(GetParam(), setting).in(filtered(type())->name, image).run()[0]);
  }
};

// P1 and P2: weights sum to 1, so what is constant stays, but for the rounding of hundreds of taps.
TEST_P(SpatialFilter, LeavesAConstantImageAlone) {
  each_setting(type(), [&](const Setting& s) {
    for (const float value : {0.0f, 0.7f, 4096.0f}) {
      const auto out = run(constant_image(kWidth, kHeight, 3, value), s);
      EXPECT_LE(largest_difference(out, [&](int, int, int) { return double(value); }), 7e-6 * double(value));
    }
  });
}

// How far the filtered image is read.
quell_reach reach_of(const NodeType& type, const Setting& setting) {
  Instance instance(type);
  for (std::size_t i = 0; i < type.params().size(); ++i)
    for (int c = 0; c < type.params()[i].choice_count; ++c)
      if (setting == Setting{type.params()[i].name, type.params()[i].choices[c]}) instance.set_int(int(i), c);
  return instance.reach()[std::size_t(type.outputs()[0].passes)];
}

// P3: no weight is negative, so nothing leaves the range of what is read around the pixel.
TEST_P(SpatialFilter, StaysInTheRangeOfItsWindow) {
  const auto image = picture(101);
  each_setting(type(), [&](const Setting& s) {
    const auto out = run(image, s);
    const auto reach = reach_of(type(), s);
    ASSERT_EQ(reach.anywhere, 0);
    // What takes radiance may scale a colour as a whole, or mix its channels: these keep to each other's range, and a
    // channel may fall below all others of its kind, but not below 0.
    const bool colors = filtered(type())->type == QUELL_RADIANCE;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        float low[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF}, high[3] = {};
        for (int v = std::max(0, y - reach.up); v <= std::min(kHeight - 1, y + reach.down); ++v)
          for (int u = std::max(0, x - reach.left); u <= std::min(kWidth - 1, x + reach.right); ++u)
            for (int c = 0; c < 3; ++c)
              low[c] = std::min(low[c], image.at(c, u, v)), high[c] = std::max(high[c], image.at(c, u, v));
        for (int c = 0; c < 3; ++c) {
          ASSERT_GE(out.at(c, x, y), colors ? 0 : low[c] * (1 - 1e-5f)) << x << "," << y;
          ASSERT_LE(out.at(c, x, y), (colors ? *std::max_element(high, high + 3) : high[c]) * (1 + 1e-5f))
              << x << "," << y;
        }
      }
  });
}

// P4: twice the light in is twice the light out; powers of two do not round.
TEST_P(SpatialFilter, FollowsTheExposure) {
  const auto image = picture(103);
  for (const float scale : {0.25f, 8.0f}) {
    auto bright = image.copy();
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) bright.at(c, x, y) *= scale;
    each_setting(type(), [&](const Setting& s) {
      const auto out = run(image, s), brighter = run(bright, s);
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) ASSERT_EQ(brighter.at(c, x, y), scale * out.at(c, x, y)) << x << "," << y;
    });
  }
}

// P5: kernels and windows are symmetric, so a flipped image is filtered like the image; but where space is cut into
// clusters, these must fall on each other.
TEST_P(SpatialFilter, CommutesWithFlips) {
  const auto whole = picture(105);
  const int width = kWidth / 8 * 8, height = kHeight / 8 * 8;
  for (const bool horizontal : {true, false}) {
    const auto flipped = [&](int x, int y) {
      return horizontal ? std::pair(width - 1 - x, y) : std::pair(x, height - 1 - y);
    };
    Image image(width, height, 3), mirror(width, height, 3);
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          image.at(c, x, y) = whole.at(c, x, y);
          const auto [u, v] = flipped(x, y);
          mirror.at(c, u, v) = whole.at(c, x, y);
        }
    each_setting(type(), [&](const Setting& s) {
      const auto out = run(image, s), other = run(mirror, s);
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            const auto [u, v] = flipped(x, y);
            // The order of the sums differs.
            ASSERT_NEAR(other.at(c, u, v), out.at(c, x, y), 1e-5 * std::abs(out.at(c, x, y)) + 1e-6) << x << "," << y;
          }
    });
  }
}

// P5 again: rows and columns are alike, so a filter of one direction is that of the other on the transposed image.
TEST_P(SpatialFilter, CommutesWithTransposition) {
  const auto image = picture(109);
  Image turned(kHeight, kWidth, 3);
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) turned.at(c, y, x) = image.at(c, x, y);
  each_setting(type(), [&](const Setting& s) {
    Node other = node_of(GetParam(), s);
    if (type().find_param("direction") >= 0)
      other.set("direction", std::string(s.choice == "vertical" ? "horizontal" : "vertical"));
    const auto out = run(image, s), across = std::move(other.in(filtered(type())->name, turned).run()[0]);
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          ASSERT_NEAR(across.at(c, y, x), out.at(c, x, y), 1e-5 * std::abs(out.at(c, x, y)) + 1e-6) << x << "," << y;
  });
}

INSTANTIATE_TEST_SUITE_P(All, SpatialFilter, testing::ValuesIn(filters()), [](const auto& i) { return i.param; });

// P6: a filter under a weight that shuts out every neighbour gives its input.
class WeightedFilter : public testing::TestWithParam<std::string> {};
TEST_P(WeightedFilter, IsTheIdentityWhereAllIdsDiffer) {
  const auto image = noise_image(kWidth, kHeight, 3, 107);
  Image id(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) id.bits(0, y)[x] = std::uint32_t(y * kWidth + x);
  const auto& type = *registry().find(GetParam());
  Node by_id("id_weight"), node(GetParam());
  by_id.in("id", id);
  node.in(filtered(type)->name, image);
  for (const auto& port : type.inputs())
    if (port.type == QUELL_WEIGHT) node.in(port.name, by_id);
  const auto out = node.run();
  EXPECT_LE(largest_difference(out[0], [&](int c, int x, int y) { return double(image.at(c, x, y)); }), 3e-7);
}
std::vector<std::string> weighted() {
  auto list = filters();
  std::erase_if(list, [](const std::string& name) {
    return std::ranges::none_of(registry().find(name)->inputs(), [](const auto& p) { return p.type == QUELL_WEIGHT; });
  });
  return list;
}
INSTANTIATE_TEST_SUITE_P(All, WeightedFilter, testing::ValuesIn(weighted()), [](const auto& i) { return i.param; });

// What N levels of the plain kernel make of an impulse, §3.2 of the wavelet's theory.
struct Cascade {
  double sum = 0, gain = 0, spread = 0;  // Σ k, Σ k² (the gain of white noise) and the variance along x, pixels²
  int support = 0;                       // pixels along x
};
std::vector<Cascade> cascades(const std::string& kernel, int levels) {
  constexpr int kSize = 259, kMiddle = 129;
  std::vector<Cascade> list;
  Image impulse(kSize, kSize, 1);
  impulse.at(0, kMiddle, kMiddle) = 1;
  for (int level = 0; level < levels; ++level) {
    Node node("atrous");
    impulse = node.set("step", 1 << level).set("kernel", kernel).in("image", impulse).run("image");
    auto& found = list.emplace_back();
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double k = impulse.at(0, x, y);
        found.sum += k, found.gain += k * k, found.spread += k * (x - kMiddle) * (x - kMiddle);
        found.support += y == kMiddle && k > 0;
      }
  }
  return list;
}

TEST(Cascade, HasTheGainsOfB3) {
  const double gains[] = {0.0747681, 0.0152459, 0.00364327, 9.00883e-4, 2.24609e-4};
  const auto found = cascades("b3", 5);
  for (int n = 1; n <= 5; ++n) {
    const auto& c = found[std::size_t(n - 1)];
    EXPECT_NEAR(c.sum, 1, 1e-6) << n;
    EXPECT_NEAR(c.gain / gains[n - 1], 1, 1e-5) << n;
    EXPECT_NEAR(c.spread / ((std::pow(4.0, n) - 1) / 3), 1, 1e-5) << n;
    EXPECT_EQ(c.support, 4 * ((1 << n) - 1) + 1) << n;
  }
}

// The binomial spreads half as far as B3, the box two thirds.
TEST(Cascade, OfOtherKernelsSpreadsLess) {
  for (const auto& [kernel, share] : {std::pair{"binomial", 1 / 2.0}, {"box", 2 / 3.0}}) {
    const auto found = cascades(kernel, 5);
    for (int n = 1; n <= 5; ++n) {
      const auto& c = found[std::size_t(n - 1)];
      EXPECT_NEAR(c.sum, 1, 1e-5) << kernel << n;
      EXPECT_NEAR(c.spread / (share * (std::pow(4.0, n) - 1) / 3), 1, 1e-5) << kernel << n;
      EXPECT_EQ(c.support, 2 * ((1 << n) - 1) + 1) << kernel << n;
    }
  }
}

}  // namespace
}  // namespace quell::test
