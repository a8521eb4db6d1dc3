// demodulate against its formula, and modulate as its exact inverse.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

// Albedos of every kind: black, dark, usual, above 1.
Image albedos(int width, int height) {
  auto albedo = noise_image(width, height, 3, 5, 0.0f, 1.0f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        float& a = albedo.at(c, x, y);
        if (x % 5 == 1) a = 0;
        if (x % 5 == 2) a *= 1e-3f;
        if (x % 5 == 3) a *= 14;
        if (x % 5 == 4 && c == 1) a = 0;
      }
  return albedo;
}

double divisor(const std::string& mode, double floor, double ceiling, const Image& albedo, int c, int x, int y) {
  const double a = albedo.at(c, x, y);
  if (mode == "clip") return std::min(std::max(a, floor), ceiling);
  if (mode == "asymmetric") return std::max(a, double(1e-3f));
  const double brightest = std::max({albedo.at(0, x, y), albedo.at(1, x, y), albedo.at(2, x, y)});
  return brightest < 1e-3f || brightest > 1 ? 1.0 : std::max(a, double(1e-3f));
}

class Demodulation : public ::testing::TestWithParam<const char*> {};
class Inverse : public Demodulation {};

TEST_P(Demodulation, DividesByTheClippedAlbedo) {
  for (const float ceiling : {1.0f, 1.5f})
    for_each_target([&] {
      const auto color = noise_image(17, 3, 3, 1, 0.0f, 20.0f), albedo = albedos(17, 3);
      const auto out = Node("demodulate")
                           .set("mode", GetParam())
                           .set("floor", 0.2f)
                           .set("ceiling", ceiling)
                           .in("image", color)
                           .in("albedo", albedo)
                           .run("image");
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 3; ++y)
          for (int x = 0; x < 17; ++x) {
            const double expected =
                color.at(c, x, y) / divisor(GetParam(), double(0.2f), double(ceiling), albedo, c, x, y);
            EXPECT_NEAR(out.at(c, x, y), expected, 1e-7 * expected);
          }
    });
}

TEST_P(Inverse, IsModulate) {
  for_each_target([&] {
    const auto color = noise_image(17, 3, 3, 2, 0.0f, 20.0f), albedo = albedos(17, 3), aside = noise_image(17, 3, 3, 3);
    const auto node = [](const char* type) { return Node(type).set("mode", GetParam()).set("ceiling", 1.5f); };
    const auto light = node("demodulate").in("image", color).in("albedo", albedo).run("image");
    const auto back = node("modulate").in("image", light).in("albedo", albedo).run("image");
    const auto more = node("modulate").in("image", light).in("albedo", albedo).in("emission", aside).run("image");
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 17; ++x) {
          const double v = color.at(c, x, y), sum = v + aside.at(c, x, y);
          EXPECT_NEAR(back.at(c, x, y), v, 1e-6 * v);
          EXPECT_NEAR(more.at(c, x, y), sum, 1e-6 * sum);
        }
  });
}

TEST_P(Inverse, LetsLightOnBlackSurvive) {
  for_each_target([&] {
    const auto color = constant_image(3, 1, 3, 1.0f), albedo = constant_image(3, 1, 3, 0.0f);
    const auto light = Node("demodulate").set("mode", GetParam()).in("image", color).in("albedo", albedo).run("image");
    const auto back = Node("modulate").set("mode", GetParam()).in("image", light).in("albedo", albedo).run("image");
    EXPECT_FLOAT_EQ(back.at(1, 1, 0), 1.0f);
  });
}

INSTANTIATE_TEST_SUITE_P(modes, Demodulation, ::testing::Values("clip", "classic", "asymmetric"));
INSTANTIATE_TEST_SUITE_P(modes, Inverse, ::testing::Values("clip", "classic"));

TEST(DemodulationProperty, AsymmetricMultipliesByAlbedoItself) {
  for_each_target([&] {
    const auto color = noise_image(17, 3, 3, 2, 0.0f, 20.0f), albedo = albedos(17, 3);
    const auto light =
        Node("demodulate").set("mode", "asymmetric").in("image", color).in("albedo", albedo).run("image");
    const auto back = Node("modulate").set("mode", "asymmetric").in("image", light).in("albedo", albedo).run("image");
    int black = 0;
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 17; ++x) {
          const double a = albedo.at(c, x, y), expected = color.at(c, x, y) * (a / std::max(a, double(1e-3f)));
          EXPECT_NEAR(back.at(c, x, y), expected, 1e-6 * expected);
          black += a == 0 && back.at(c, x, y) == 0;
        }
    EXPECT_GT(black, 5);
  });
}

}  // namespace
