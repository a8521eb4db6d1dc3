// power against std::pow.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace quell::test {
namespace {

TEST(Power, IsItsFormula) {
  for (const float v : {-3.0f, 0.0f, 1e-6f, 0.5f, 2.0f, 1000.0f})
    for (const float exponent : {0.0f, 0.0448f, 0.5f, 1.0f, 2.0f})
      for (const float scale : {1.0f, -2.0f, 1000.0f}) {
        const auto value = constant_image(1, 1, 1, v), times = constant_image(1, 1, 1, 0.75f);
        Node alone("power"), twice("power");
        const auto one = alone.set("exponent", exponent).set("scale", scale).in("value", value).run("value");
        const auto two =
            twice.set("exponent", exponent).set("scale", scale).in("value", value).in("times", times).run("value");
        const double power = exponent == 1 ? double(v) : std::pow(v < 0 ? 0.0 : double(v), double(exponent));
        EXPECT_FLOAT_EQ(one.at(0, 0, 0), float(scale * power)) << v << "^" << exponent;
        EXPECT_FLOAT_EQ(two.at(0, 0, 0), float(scale * power * 0.75)) << v << "^" << exponent;
      }
}

TEST(Power, StaysFinite) {
  const auto value = constant_image(1, 1, 1, 1e30f);
  EXPECT_EQ(Node("power").set("exponent", 2.0f).in("value", value).run("value").at(0, 0, 0),
            std::numeric_limits<float>::max());
}

}  // namespace
}  // namespace quell::test
