// The firefly clamp against a direct evaluation of its formula, and the trap that it avoids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

double luminance(const Image& i, int x, int y) {
  return 0.2126 * i.at(0, x, y) + 0.7152 * i.at(1, x, y) + 0.0722 * i.at(2, x, y);
}

// The value at (x, y) pulled into the range of its window.
template <class Value>
double clamped(const Image& image, int x, int y, int radius, double k, bool exclude, Value&& value) {
  std::vector<double> window;
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height() - 1); ++v)
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width() - 1); ++u)
      if (!exclude || u != x || v != y) window.push_back(value(u, v));
  if (window.size() < 2) return value(x, y);
  double mean = 0, squares = 0;
  for (const double v : window) mean += v / double(window.size());
  for (const double v : window) squares += (v - mean) * (v - mean) / double(window.size());
  const double sigma = exclude ? std::max(std::sqrt(squares), 1e-3 * std::abs(mean)) : std::sqrt(squares);
  return std::clamp(value(x, y), mean - k * sigma, mean + k * sigma);
}

Image with_fireflies(int width, int height) {
  auto image = noise_image(width, height, 3, 3);
  for (int y = 0; y < height; y += 4)
    for (int x = y % 3; x < width; x += 7) image.at((x + y) % 3, x, y) = 1e4f;
  return image;
}

struct Case {
  int width, height, radius;
  float k;
  bool exclude;
};

class OutlierClamp : public ::testing::TestWithParam<Case> {};

TEST_P(OutlierClamp, ByChannelIsItsFormula) {
  for_each_target([&] {
    const auto [width, height, radius, k, exclude] = GetParam();
    const auto image = with_fireflies(width, height);
    const auto out = Node("outlier_clamp")
                         .set("radius", radius)
                         .set("k", k)
                         .set("exclude_center", exclude)
                         .in("image", image)
                         .run("image");
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double expected =
              clamped(image, x, y, radius, k, exclude, [&](int u, int v) { return double(image.at(c, u, v)); });
          EXPECT_NEAR(out.at(c, x, y), expected, 1e-6 * std::max(expected, 1.0)) << c << ' ' << x << ',' << y;
        }
  });
}

TEST_P(OutlierClamp, ByLuminanceKeepsTheHue) {
  for_each_target([&] {
    const auto [width, height, radius, k, exclude] = GetParam();
    const auto image = with_fireflies(width, height);
    const auto out = Node("outlier_clamp")
                         .set("mode", "luminance")
                         .set("radius", radius)
                         .set("k", k)
                         .set("exclude_center", exclude)
                         .in("image", image)
                         .run("image");
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double to =
            clamped(image, x, y, radius, k, exclude, [&](int u, int v) { return luminance(image, u, v); });
        for (int c = 0; c < 3; ++c) {
          const double expected = image.at(c, x, y) * to / luminance(image, x, y);
          EXPECT_NEAR(out.at(c, x, y), expected, 3e-6 * std::max(expected, 1.0)) << c << ' ' << x << ',' << y;
        }
      }
  });
}

INSTANTIATE_TEST_SUITE_P(sizes, OutlierClamp,
                         ::testing::Values(Case{33, 17, 3, 2, true}, Case{33, 17, 3, 2, false},
                                           Case{33, 17, 1, 0.5f, true}, Case{17, 3, 5, 1, true}, Case{1, 9, 3, 1, true},
                                           Case{9, 1, 3, 1, false}, Case{2, 1, 3, 1, true}, Case{1, 1, 3, 1, true},
                                           Case{1, 1, 3, 1, false}));

TEST(OutlierClampProperty, FindsWhatStatisticsWithTheCentreCannot) {
  for_each_target([&] {
    // One outlier among 49 equal values lies at √48 = 6.93 sigma of them all, however large it is.
    auto image = constant_image(15, 15, 3, 1.0f);
    for (int c = 0; c < 3; ++c) image.at(c, 7, 7) = 1e6f;
    for (const auto& [k, exclude, removed] :
         {std::tuple{7.0f, false, false}, {6.8f, false, true}, {7.0f, true, true}}) {
      const auto out = Node("outlier_clamp").set("k", k).set("exclude_center", exclude).in("image", image).run("image");
      EXPECT_EQ(out.at(0, 7, 7) < 1e6f, removed) << k << ' ' << exclude;
      if (exclude) {
        // What the least spread, 0.1 % of the mean, allows.
        EXPECT_NEAR(out.at(0, 7, 7), 1.007, 1e-5);
      }
    }
  });
}

TEST(OutlierClampProperty, LeavesAllAloneWithinAWideRange) {
  for_each_target([&] {
    const auto image = noise_image(33, 9, 3, 5);
    for (const char* mode : {"channel", "luminance"})
      for (const bool exclude : {true, false}) {
        const auto out = Node("outlier_clamp")
                             .set("k", 1e6f)
                             .set("mode", mode)
                             .set("exclude_center", exclude)
                             .in("image", image)
                             .run("image");
        for (int c = 0; c < 3; ++c)
          for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 33; ++x) EXPECT_EQ(out.at(c, x, y), image.at(c, x, y)) << mode << exclude;
      }
  });
}

TEST(OutlierClampProperty, KeepsWhatIsConstant) {
  for_each_target([&] {
    const auto image = constant_image(33, 9, 3, 0.3f);
    for (const char* mode : {"channel", "luminance"})
      for (const bool exclude : {true, false}) {
        const auto out =
            Node("outlier_clamp").set("mode", mode).set("exclude_center", exclude).in("image", image).run("image");
        for (int y = 0; y < 9; ++y)
          for (int x = 0; x < 33; ++x) EXPECT_FLOAT_EQ(out.at(2, x, y), 0.3f) << mode << exclude << x << ',' << y;
      }
  });
}

}  // namespace
