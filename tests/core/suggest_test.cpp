// Did you mean: near names are found, far ones are not.
#include "core/report/suggest.h"

#include <gtest/gtest.h>

#include <vector>

namespace quell {
namespace {

const std::vector<std::string> kNames{"image", "variance", "weights", "normal_weight", "plane_weight"};

TEST(Suggest, FindsSlips) {
  EXPECT_EQ(nearest("imgae", kNames), "image");  // a swap
  EXPECT_EQ(nearest("varience", kNames), "variance");
  EXPECT_EQ(nearest("weight", kNames), "weights");
  EXPECT_EQ(nearest("Image", kNames), "image");
  EXPECT_EQ(nearest("normal", kNames), "normal_weight");  // a beginning
}

TEST(Suggest, KeepsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest("colour", kNames), "");
  EXPECT_EQ(nearest("", kNames), "");
  EXPECT_EQ(nearest("x", kNames), "");
  EXPECT_EQ(nearest("image", {}), "");
  EXPECT_EQ(nearest(std::string(100000, 'i'), kNames), "");
}

TEST(Suggest, ListsPossibilities) {
  const std::vector<std::string> two{"image", "variance"};
  EXPECT_EQ(possibilities("it has", "imge", two), "it has: image, variance. Did you mean 'image'?");
  EXPECT_EQ(possibilities("it has", "colour", two), "it has: image, variance");
  EXPECT_EQ(possibilities("it has", "colour", {}), "");
}

TEST(Suggest, ListsTwelveAtMost) {
  std::vector<std::string> many;
  for (int i = 0; i < 15; ++i) many.push_back("n" + std::to_string(100 + i));
  EXPECT_EQ(possibilities("one of", "zzz", many),
            "one of: n100, n101, n102, n103, n104, n105, n106, n107, n108, n109, n110, n111 and 3 more");
}

}  // namespace
}  // namespace quell
