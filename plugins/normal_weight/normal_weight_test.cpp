// normal_weight against its formula in double precision.
#include "tests/support/falloffs.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 150, kHeight = 19;

bool is_miss(const Image& n, int x, int y) { return n.at(0, x, y) == 0 && n.at(1, x, y) == 0 && n.at(2, x, y) == 0; }

double cosine(const Image& n, int x, int y, int dx, int dy) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += double(n.at(c, x, y)) * n.at(c, x + dx, y + dy);
  return std::clamp(sum, 0.0, 1.0);
}

template <class Falloff>
WeightFormula formula(const Image& n, Falloff falloff) {
  return [&n, falloff](int x, int y, int dx, int dy) {
    const bool here = is_miss(n, x, y), there = is_miss(n, x + dx, y + dy);
    return here || there ? double(here && there) : falloff(cosine(n, x, y, dx, dy));
  };
}

// Floats hold n·n' to 1e-7, of which a power makes power·1e-7; the series adds 1e-5 where it is coarsest.
TEST(NormalWeight, Power) {
  const auto normal = normal_image(kWidth, kHeight, 3, true);
  for (const float power : {1.0f, 8.0f, 47.0f, 48.0f, 128.0f, 1000.0f}) {
    SCOPED_TRACE(power);
    Node node("normal_weight");
    node.set("power", power).in("normal", normal);
    check_weight(node, kWidth, kHeight, formula(normal, [=](double c) { return std::pow(c, double(power)); }),
                 2e-5 + 3e-7 * power);
  }
}

TEST(NormalWeight, Angle) {
  const auto normal = normal_image(kWidth, kHeight, 4, true);
  for (const float sigma : {0.05f, 0.117f, 0.118f, 0.5f, 3.0f}) {
    SCOPED_TRACE(sigma);
    Node node("normal_weight");
    node.set("mode", "angle").set("sigma", sigma).in("normal", normal);
    // 1 - n·n' is held to 1e-7, the squared angle to 2e-7.
    check_weight(
        node, kWidth, kHeight,
        formula(normal, [=](double c) { return std::exp(-std::pow(std::acos(c), 2) / (2.0 * sigma * sigma)); }),
        1e-6 + 2e-7 / (sigma * sigma));
  }
}

// Angles are held to 1e-7 of themselves where normals are nearly equal, and to 1e-6 elsewhere.
TEST(NormalWeight, EveryFalloff) {
  const auto normal = normal_image(kWidth, kHeight, 5, true);
  for (const auto& name : falloff_names())
    for (const bool angle : {true, false})
      for (const float sigma : {0.02f, 0.4f, 2.0f}) {
        SCOPED_TRACE(testing::Message() << name << " " << angle << " " << sigma);
        Node node("normal_weight");
        node.set("mode", angle ? "angle" : "difference").set("sigma", sigma).set("falloff", name).in("normal", normal);
        check_weight(
            node, kWidth, kHeight,
            [&](int x, int y, int dx, int dy) {
              if (is_miss(normal, x, y) || is_miss(normal, x + dx, y + dy))
                return double(is_miss(normal, x, y) && is_miss(normal, x + dx, y + dy));
              double squared = 0;
              for (int c = 0; c < 3; ++c)
                squared += std::pow(double(normal.at(c, x, y)) - normal.at(c, x + dx, y + dy), 2);
              // Normals are of unit length to 1e-7 only, so the angle is taken from their difference, not their cosine.
              const double chord = std::sqrt(squared), whole = 2 * std::asin(std::min(1.0, chord / 2));
              return falloff(name, (angle ? std::min(whole, std::acos(0.0)) : chord) / sigma);
            },
            1e-5 + 2e-7 / (sigma * sigma));
      }
}

TEST(NormalWeight, ScaleMultipliesSigma) {
  const auto normal = normal_image(kWidth, kHeight, 6, true);
  for (const char* mode : {"angle", "difference"}) {
    Node scaled("normal_weight"), plain("normal_weight");
    scaled.set("mode", mode).set("sigma", 0.25f).set("scale", 2.0f).in("normal", normal);
    plain.set("mode", mode).set("sigma", 0.5f).in("normal", normal);
    for (int y = 0; y < kHeight - 1; ++y)
      EXPECT_EQ(weights_of(scaled, kWidth, kHeight, y, {{2, 1}}, false),
                weights_of(plain, kWidth, kHeight, y, {{2, 1}}, false));
  }
}

TEST(NormalWeight, APowerTakesNoFalloff) {
  const auto normal = normal_image(8, 3, 7);
  Node node("normal_weight");
  node.in("normal", normal).set("falloff", "tent");
  try {
    node.shapes();
    ADD_FAILURE() << "it did";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("set mode to angle or difference"), std::string::npos) << e.what();
  }
  EXPECT_NO_THROW(node.set("mode", "angle").shapes());
}

// The miss test of a segment must not be fooled by single zero components.
TEST(NormalWeight, AxisNormalsAreNoMisses) {
  Image normal(40, 3, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 40; ++x) normal.at(x % 3, x, y) = x % 2 ? -1.0f : 1.0f;
  for (const char* mode : {"power", "angle"}) {
    Node node("normal_weight");
    node.set("mode", mode).in("normal", normal);
    check_weight(node, 40, 3, formula(normal, [](double c) { return c > 0.5 ? 1.0 : 0.0; }), 1e-6);
  }
}

}  // namespace
}  // namespace quell::test
