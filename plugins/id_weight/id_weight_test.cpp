// id_weight against equality of numbers: also of those that would be NaN or denormal as floats.
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>
#include <quell/types.h>

namespace quell::test {
namespace {

TEST(IdWeight, IsEquality) {
  constexpr int kWidth = 150, kHeight = 19;
  const auto choice = noise_image(kWidth, kHeight, 1, 63);
  const std::uint32_t numbers[] = {0, 1, 2, 0x80000000u, 0x7FC00000u, kNoId};
  Image id(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) id.bits(0, y)[x] = numbers[int(choice.at(0, x, y) * 5.999f)];
  Node node("id_weight");
  node.in("id", id);
  check_weight(
      node, kWidth, kHeight,
      [&](int x, int y, int dx, int dy) { return double(id.bits(0, y)[x] == id.bits(0, y + dy)[x + dx]); }, 0);
}

// A filter under it is one of each object by itself.
TEST(IdWeight, NothingCrosses) {
  Image id(64, 16, 1), image(64, 16, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 64; ++x) {
      id.bits(0, y)[x] = x < 37 ? 4 : kNoId;
      for (int c = 0; c < 3; ++c) image.at(c, x, y) = x < 37 ? 0.25f : 1e6f;
    }
  Node by_id("id_weight"), filter("window");
  filter.in("image", image).in("weights", by_id.in("id", id));
  const auto out = filter.run("image");
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 64; ++x) ASSERT_NEAR(out.at(0, x, y) / image.at(0, x, y), 1, 5e-6) << x << "," << y;
}

}  // namespace
}  // namespace quell::test
