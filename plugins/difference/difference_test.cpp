// difference against its formulas in double.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace quell::test {
namespace {

// The measure of one channel; `mean` is that of the reference's channels.
double error(const std::string& measure, double x, double a, double b, double mean, double epsilon) {
  const double y = (a + b) / 2, square = (x - a) * (x - b);
  if (measure == "squared") return square;
  if (measure == "absolute") return std::abs(x - y);
  if (measure == "signed") return x - y;
  if (measure == "relative") return square / (y * y + epsilon);
  if (measure == "relative_mean") return square / (mean * mean + epsilon);
  if (measure == "mrse") return square / std::pow(std::abs(y) + epsilon, 2);
  if (measure == "mape") return std::abs(x - y) / (std::abs(y) + epsilon);
  return std::abs(x - y) / (std::abs(x) + std::abs(y) + epsilon);
}

class Difference : public ::testing::TestWithParam<const char*> {};

TEST_P(Difference, IsItsFormula) {
  const std::string measure = GetParam();
  const bool squares = measure != "absolute" && measure != "signed" && measure != "smape" && measure != "mape";
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {37, 11}})
    for (const int channels : {1, 3, 5})
      for (const bool halves : {false, true}) {
        if (halves && !squares) continue;
        auto x = noise_image(width, height, channels, 1, 0, 4), a = noise_image(width, height, channels, 2, 0, 4),
             b = noise_image(width, height, channels, 3, 0, 4), mask = noise_image(width, height, 1, 4, -0.2f, 1);
        a.at(0, width / 2, height / 2) = b.at(0, width / 2, height / 2) = 0;
        Node node("difference");
        node.set("measure", measure).set("epsilon", 0.02f).in("image", x).in("reference", a).in("mask", mask);
        if (halves) node.in("reference_b", b);
        const auto map = node.run("map");
        const Image& second = halves ? b : a;
        for (int v = 0; v < height; ++v)
          for (int u = 0; u < width; ++u) {
            double mean = 0, expected = 0;
            for (int c = 0; c < channels; ++c) mean += (double(a.at(c, u, v)) + second.at(c, u, v)) / 2 / channels;
            for (int c = 0; c < channels; ++c)
              expected +=
                  error(measure, x.at(c, u, v), a.at(c, u, v), second.at(c, u, v), mean, double(0.02f)) / channels;
            if (mask.at(0, u, v) <= 0) expected = 0;
            // The node reckons in double as well; what is left is the rounding to float.
            ASSERT_NEAR(map.at(0, u, v), expected, 1e-7 * std::abs(expected) + 1e-14) << u << "," << v;
          }
      }
}

TEST_P(Difference, IsNoneToItself) {
  const auto image = noise_image(19, 7, 3, 5, 0, 100);
  Node node("difference");
  const auto map = node.set("measure", GetParam()).set("epsilon", 0.0f).in("image", image).in("reference", image).run();
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 19; ++x) EXPECT_EQ(map[0].at(0, x, y), 0.0f);
}

INSTANTIATE_TEST_SUITE_P(measures, Difference,
                         ::testing::Values("squared", "absolute", "signed", "relative", "relative_mean", "mrse",
                                           "smape", "mape"));

TEST(DifferenceMeasures, OfRatiosDoNotDependOnExposure) {
  const auto x = noise_image(31, 8, 3, 1), y = noise_image(31, 8, 3, 2);
  auto x8 = x.copy(), y8 = y.copy();
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < 8; ++v)
      for (int u = 0; u < 31; ++u) x8.at(c, u, v) *= 8, y8.at(c, u, v) *= 8;
  for (const char* measure : {"relative", "relative_mean", "mrse", "smape", "mape"}) {
    Node one("difference"), eight("difference");
    const auto map = one.set("measure", measure).set("epsilon", 0.0f).in("image", x).in("reference", y).run("map");
    const auto map8 = eight.set("measure", measure).set("epsilon", 0.0f).in("image", x8).in("reference", y8).run("map");
    for (int v = 0; v < 8; ++v)
      for (int u = 0; u < 31; ++u) ASSERT_EQ(map.at(0, u, v), map8.at(0, u, v)) << measure;
  }
}

TEST(DifferenceMeasures, StayFinite) {
  const auto bright = constant_image(5, 1, 1, 3e38f), black = constant_image(5, 1, 1, 0);
  Node square("difference"), ratio("difference");
  EXPECT_EQ(square.in("image", bright).in("reference", black).run("map").at(0, 2, 0),
            std::numeric_limits<float>::max());
  ratio.set("measure", "relative").set("epsilon", 0.0f);
  EXPECT_EQ(ratio.in("image", bright).in("reference", black).run("map").at(0, 2, 0), std::numeric_limits<float>::max());
}

// Two halves with noise of their own: the plain error holds the reference's variance, the product of two does not.
TEST(DifferenceMeasures, LoseTheNoiseOfAReferenceInHalves) {
  constexpr int kSize = 256;
  const auto noise_a = noise_image(kSize, kSize, 1, 11, -0.5f, 0.5f),
             noise_b = noise_image(kSize, kSize, 1, 12, -0.5f, 0.5f);
  const auto x = constant_image(kSize, kSize, 1, 2.1f);
  auto a = constant_image(kSize, kSize, 1, 2), b = constant_image(kSize, kSize, 1, 2);
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) a.at(0, u, v) += noise_a.at(0, u, v), b.at(0, u, v) += noise_b.at(0, u, v);
  const auto mean = [](const Image& map) {
    double sum = 0;
    for (int v = 0; v < kSize; ++v)
      for (int u = 0; u < kSize; ++u) sum += map.at(0, u, v);
    return sum / (kSize * kSize);
  };
  Node plain("difference"), halves("difference");
  EXPECT_NEAR(mean(plain.in("image", x).in("reference", a).run("map")), 0.01 + 1.0 / 12, 2e-3);
  // Standard deviation of the mean: (1/12 + 2 · 0.01 / 12) / 256 = 3.6e-4 at most.
  EXPECT_NEAR(mean(halves.in("image", x).in("reference", a).in("reference_b", b).run("map")), 0.01, 1.2e-3);
}

TEST(DifferenceMeasures, RefuseWhatTheyCannotCompare) {
  const auto three = constant_image(4, 4, 3, 1), one = constant_image(4, 4, 1, 1);
  const auto said = [](Node& node) -> std::string {
    try {
      node.run();
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  };
  Node channels("difference"), halves("difference");
  EXPECT_NE(said(channels.in("image", three).in("reference", one))
                .find("image has 3 channels and reference has 1: they must be of one kind"),
            std::string::npos);
  halves.set("measure", "smape").in("image", three).in("reference", three).in("reference_b", three);
  EXPECT_NE(said(halves).find("reference_b goes with the measures that square"), std::string::npos);
}

}  // namespace
}  // namespace quell::test
