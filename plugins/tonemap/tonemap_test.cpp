// tonemap against its formulas in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::for_each_target;
using quell::test::Node;

struct Rgb {
  double r, g, b;
};

double narkowicz(double v) {
  const double x = 0.6 * v;
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}
double hable_film(double x) {
  const double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}
double mapped(const std::string& curve, double v, double luminance) {
  v = std::min(v, 65536.0);
  if (curve == "reinhard") v /= 1 + luminance;
  if (curve == "aces") v = narkowicz(v);
  if (curve == "hable") v = hable_film(v) / hable_film(11.2);
  return std::clamp(v, 0.0, 1.0);
}
double srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

// Black, each part of the curves, their ends and far beyond; grey and coloured.
Image radiances() {
  Image image(67, 3, 3);
  for (int x = 0; x < image.width(); ++x) {
    const float v = x == 0 ? 0.0f : x == 66 ? 3e38f : std::exp2(float(x) * 0.5f - 16);
    for (int y = 0; y < 3; ++y)
      for (int c = 0; c < 3; ++c) image.at(c, x, y) = c < y ? 0.25f * v : v;
  }
  return image;
}

class Tonemap : public ::testing::TestWithParam<const char*> {};

TEST_P(Tonemap, IsItsFormula) {
  const auto image = radiances();
  for_each_target([&] {
    const auto linear =
        Node("tonemap").set("operator", GetParam()).set("encoding", "linear").in("image", image).run("image");
    const auto encoded = Node("tonemap").set("operator", GetParam()).in("image", image).run("image");
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto v = [&](int c) { return std::min(double(image.at(c, x, y)), 65536.0); };
        const double luminance = 0.2126 * v(0) + 0.7152 * v(1) + 0.0722 * v(2);
        for (int c = 0; c < 3; ++c) {
          const double expected = mapped(GetParam(), v(c), luminance);
          // A handful of roundings of 6e-8; a power adds the error of exp2 and of a logarithm of up to 8.3 / 2.4.
          ASSERT_NEAR(linear.at(c, x, y), expected, 5e-7 * expected) << x << "," << y << "," << c;
          ASSERT_NEAR(encoded.at(c, x, y), srgb(expected), 2e-6 * srgb(expected)) << x << "," << y << "," << c;
        }
      }
  });
}

TEST_P(Tonemap, RisesFromBlackAndStaysInRange) {
  const auto image = radiances();
  for_each_target([&] {
    const auto out = Node("tonemap").set("operator", GetParam()).in("image", image).run("image");
    EXPECT_EQ(out.at(0, 0, 0), 0.0f);
    for (int x = 1; x < image.width(); ++x) {
      EXPECT_GE(out.at(0, x, 0), out.at(0, x - 1, 0));
      EXPECT_LE(out.at(0, x, 0), 1.0f);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(operators, Tonemap, ::testing::Values("clamp", "reinhard", "aces", "hable"));

// HDR-FLIP takes its exposures from where the curve reaches 0.85.
TEST(TonemapConstants, AcesIsWhereFlipExpectsIt) {
  const auto out = Node("tonemap")
                       .set("operator", "aces")
                       .set("encoding", "linear")
                       .in("image", quell::test::constant_image(1, 1, 3, 2.1188724f))
                       .run("image");
  EXPECT_NEAR(out.at(1, 0, 0), 0.85, 1e-6);
}

}  // namespace
