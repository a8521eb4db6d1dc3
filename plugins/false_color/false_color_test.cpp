// false_color against its formula in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <quell/types.h>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

double turbo(int c, double x) {
  static constexpr double k[3][6] = {{0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943},
                                     {0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604},
                                     {0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973}};
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += k[c][i] * std::pow(x, i);
  return std::clamp(sum, 0.0, 1.0);
}

TEST(FalseColor, IsItsFormula) {
  auto image = noise_image(67, 3, 2, 1, -2.0f, 9.0f);
  image.at(1, 3, 1) = 0, image.at(1, 4, 1) = 1e20f, image.at(1, 5, 1) = quell::kFar;
  const auto stops = constant_image(1, 1, 1, 0.5f);
  for_each_target([&] {
    for (const bool log : {false, true}) {
      const auto out = Node("false_color")
                           .set("channel", 1)
                           .set("log", log)
                           .set("low", -1.0f)
                           .set("high", 2.5f)
                           .in("image", image)
                           .in("stops", stops)
                           .run("image");
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 67; ++x) {
          const double v = image.at(1, x, y);
          const double at = !log ? v : v > 0 ? std::log2(v) + 0.5 : -1e9;
          const double place = std::clamp((at + 1) / 3.5, 0.0, 1.0);
          for (int c = 0; c < 3; ++c) {
            // Terms of up to 153 that cancel, each rounded at 6e-8 of itself, and slopes of up to 50 of a place that is
            // good to 1e-7.
            ASSERT_NEAR(out.at(c, x, y), v < 5e29 ? turbo(c, place) : 0.0, 4e-5) << x << "," << y << "," << log;
          }
        }
    }
  });
}

TEST(FalseColor, GreyIsThePlaceItself) {
  const auto image = noise_image(17, 3, 1, 2);
  for_each_target([&] {
    const auto out = Node("false_color").set("map", "grey").in("image", image).run("image");
    for (int x = 0; x < 17; ++x)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(out.at(c, x, 2), image.at(0, x, 2));
  });
}

TEST(FalseColor, RefusesWhatItCannotShow) {
  const auto image = constant_image(3, 3, 2, 1);
  const auto failure = [&](auto&& node) {
    try {
      node.run("image");
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(failure(Node("false_color").set("low", 1.0f).in("image", image)), "low must be below high");
  EXPECT_EQ(failure(Node("false_color").set("channel", 2).in("image", image)),
            "there is no channel 2: the image has 2, from 0");
}

}  // namespace
