// moments_variance against its formula.
#include "tests/support/run_node.h"
#include "tests/support/typical_input.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>

namespace quell::test {
namespace {

TEST(MomentsVariance, IsItsFormula) {
  auto moments = typical_input(QUELL_MOMENTS, 67, 21, 85);
  for (int x = 0; x < 67; x += 3) moments.at(1, x, 4) = 0.5f * moments.at(0, x, 4) * moments.at(0, x, 4);  // rounding
  Node node("moments_variance");
  const auto out = node.in("moments", moments).run("variance");
  EXPECT_LE(largest_difference(out,
                               [&](int, int x, int y) {
                                 const double m = moments.at(0, x, y);
                                 return std::max(0.0, moments.at(1, x, y) - m * m);
                               }),
            1e-7);
  EXPECT_EQ(out.at(0, 3, 4), 0);
}

}  // namespace
}  // namespace quell::test
