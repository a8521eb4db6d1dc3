// normalize against its formula.
#include "tests/support/run_node.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

TEST(Normalize, IsItsFormula) {
  auto normal = noise_image(67, 21, 3, 93, -3, 3);
  for (int x = 0; x < 67; x += 4)
    for (int c = 0; c < 3; ++c) normal.at(c, x, 5) = x % 8 ? 0.0f : 4e-4f;
  Node node("normalize");
  EXPECT_LE(largest_difference(node.in("normal", normal).run("normal"),
                               [&](int c, int x, int y) {
                                 double squared = 0;
                                 for (int k = 0; k < 3; ++k) squared += std::pow(double(normal.at(k, x, y)), 2);
                                 return squared < 1e-6 ? 0 : normal.at(c, x, y) / std::sqrt(squared);
                               }),
            3e-7);
}

}  // namespace
}  // namespace quell::test
