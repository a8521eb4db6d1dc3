// plane_weight against its formula in double precision.
#include "tests/support/falloffs.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace quell::test {
namespace {

constexpr int kWidth = 150, kHeight = 19;

struct Scene {
  Image normal = normal_image(kWidth, kHeight, 11, true), position = noise_image(kWidth, kHeight, 3, 12, -2.0f, 2.0f);

  Scene() {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < 3; ++c) {
          if (miss(x, y)) position.at(c, x, y) = 7;                 // anything: it must not be looked at
          if (!miss(x, y) && x % 5 == 0) position.at(c, x, y) = 1;  // points that coincide
        }
  }
  bool miss(int x, int y) const {
    return normal.at(0, x, y) == 0 && normal.at(1, x, y) == 0 && normal.at(2, x, y) == 0;
  }
  double weight(int x, int y, int dx, int dy, double sigma, bool sine, const std::string& name = "gaussian") const {
    const bool here = miss(x, y), there = miss(x + dx, y + dy);
    if (here || there) return here && there;
    double away = 0, squared = 0;
    for (int c = 0; c < 3; ++c) {
      const double d = double(position.at(c, x + dx, y + dy)) - position.at(c, x, y);
      away += normal.at(c, x, y) * d, squared += d * d;
    }
    if (squared == 0) return 1;
    return falloff(name, std::sqrt(away * away / (sine ? squared : 1)) / sigma);
  }
};

// Both metrics are of order 1 and held to a few 1e-7; the falloff multiplies that by 1/sigma².
TEST(PlaneWeight, Formula) {
  const Scene scene;
  for (const char* mode : {"sine", "distance"})
    for (const float sigma : {0.1f, 1.0f}) {
      SCOPED_TRACE(mode);
      Node node("plane_weight");
      node.set("mode", mode).set("sigma", sigma).in("normal", scene.normal).in("position", scene.position);
      const bool sine = mode[0] == 's';
      check_weight(
          node, kWidth, kHeight, [&](int x, int y, int dx, int dy) { return scene.weight(x, y, dx, dy, sigma, sine); },
          1e-6 / (sigma * sigma));
    }
}

// The distance itself is held to 1e-6; sigma is 0.5 and the steepest falloff, the rational, falls by 3.
TEST(PlaneWeight, EveryFalloff) {
  const Scene scene;
  for (const auto& name : falloff_names())
    for (const bool sine : {true, false}) {
      SCOPED_TRACE(testing::Message() << name << " " << sine);
      Node node("plane_weight");
      node.set("mode", sine ? "sine" : "distance").set("sigma", 0.5f).set("falloff", name);
      node.in("normal", scene.normal).in("position", scene.position);
      check_weight(
          node, kWidth, kHeight,
          [&](int x, int y, int dx, int dy) { return scene.weight(x, y, dx, dy, 0.5, sine, name); }, 6e-6);
    }
}

}  // namespace
}  // namespace quell::test
