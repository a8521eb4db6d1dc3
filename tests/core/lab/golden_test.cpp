// Pictures against golden ones: what counts as another pixel, and what is said.
#include "core/lab/golden.h"

#include "core/image/image.h"

#include <gtest/gtest.h>

namespace quell {
namespace {

class Golden : public testing::Test {
 protected:
  Golden() : picture_(10, 10, 3), golden_(10, 10, 3) {
    for (auto* image : {&picture_, &golden_}) image->fill(1.0f);
  }
  std::string problem(const GoldenTolerance& t) {
    return compare_golden(picture_.view(), golden_.view(), t).problem(t);
  }
  Image picture_, golden_;
};

TEST_F(Golden, TheSameIsNoProblem) { EXPECT_EQ(problem({0, 0, 0}), ""); }

TEST_F(Golden, AShareOfThePixelsMayDiffer) {
  picture_.at(1, 3, 4) = 3;     // T: 0.5 and 0.75
  picture_.at(2, 5, 4) = 1.5f;  // 0.6
  EXPECT_EQ(problem({0.05, 0.02, 1}), "");
  EXPECT_EQ(problem({0.05, 0.01, 1}),
            "2 of 100 pixels (2 %) differ by more than 0.05, and 1 % may; the largest difference is 0.25, at 3,4");
  EXPECT_EQ(problem({0.15, 0.01, 1}), "") << "the smaller of the two is within the tolerance";
  EXPECT_EQ(problem({0.05, 0.02, 0.2}), "no pixel may differ by more than 0.2; the largest difference is 0.25, at 3,4");
}

TEST_F(Golden, BrightPixelsCountAsTheEyeTakesThem) {
  picture_.at(0, 0, 0) = 1000;
  golden_.at(0, 0, 0) = 900;
  EXPECT_EQ(problem({0.001, 0, 1}), "");
}

}  // namespace
}  // namespace quell
