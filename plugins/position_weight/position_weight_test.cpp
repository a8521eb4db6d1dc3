// position_weight against its formula in double precision.
#include "tests/support/falloffs.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 150, kHeight = 19;

// A surface that bends, in front of nothing.
Image positions() {
  auto image = noise_image(kWidth, kHeight, 3, 61);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool miss = image.at(0, x, y) < 0.1f;
      image.at(0, x, y) = miss ? 0 : 0.03f * float(x);
      image.at(1, x, y) = miss ? 0 : 0.02f * float(y);
      image.at(2, x, y) = miss ? 0 : 3 + 0.1f * image.at(2, x, y);
    }
  return image;
}

bool is_miss(const Image& p, int x, int y) { return p.at(2, x, y) == 0; }

TEST(PositionWeight, EveryFalloff) {
  const auto position = positions();
  for (const auto& name : falloff_names()) {
    SCOPED_TRACE(name);
    Node node("position_weight");
    node.set("sigma", 0.3f).set("falloff", name).in("position", position);
    check_weight(
        node, kWidth, kHeight,
        [&](int x, int y, int dx, int dy) {
          const bool here = is_miss(position, x, y), there = is_miss(position, x + dx, y + dy);
          if (here || there) return double(here && there);
          double squared = 0;
          for (int c = 0; c < 3; ++c)
            squared += std::pow(double(position.at(c, x, y)) - position.at(c, x + dx, y + dy), 2);
          return falloff(name, std::sqrt(squared) / 0.3);
        },
        5e-6);
  }
}

}  // namespace
}  // namespace quell::test
