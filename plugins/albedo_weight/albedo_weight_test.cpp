// albedo_weight against its formula in double precision.
#include "tests/support/falloffs.h"
#include "tests/support/typical_input.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <cmath>

namespace quell::test {
namespace {

TEST(AlbedoWeight, EveryFalloff) {
  constexpr int kWidth = 150, kHeight = 19;
  const auto albedo = typical_input(QUELL_ALBEDO, kWidth, kHeight, 62);
  for (const auto& name : falloff_names()) {
    SCOPED_TRACE(name);
    Node node("albedo_weight");
    node.set("sigma", 0.7f).set("falloff", name).in("albedo", albedo);
    check_weight(
        node, kWidth, kHeight,
        [&](int x, int y, int dx, int dy) {
          double squared = 0;
          for (int c = 0; c < 3; ++c) squared += std::pow(double(albedo.at(c, x, y)) - albedo.at(c, x + dx, y + dy), 2);
          return falloff(name, std::sqrt(squared) / 0.7);
        },
        5e-6);
  }
}

}  // namespace
}  // namespace quell::test
