// color_weight against its formula in double precision.
#include "tests/support/falloffs.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 150, kHeight = 19;

// Channels go in threes and ones, so all remainders are of interest.
TEST(ColorWeight, AnyNumberOfChannels) {
  for (const int channels : {1, 2, 3, 4, 5, 7}) {
    SCOPED_TRACE(channels);
    const auto image = noise_image(kWidth, kHeight, channels, 13);
    Node node("color_weight");
    node.set("sigma", 0.3f).in("image", image);
    check_weight(
        node, kWidth, kHeight,
        [&](int x, int y, int dx, int dy) {
          double squared = 0;
          for (int c = 0; c < channels; ++c)
            squared += std::pow(double(image.at(c, x, y)) - image.at(c, x + dx, y + dy), 2);
          return std::exp(-squared / (2 * 0.3 * 0.3));
        },
        5e-6);
  }
}

// Three channels and one have kernels of their own; a sum of squares under the root is held to 1e-7 of itself.
TEST(ColorWeight, EveryFalloff) {
  for (const auto& name : falloff_names())
    for (const int channels : {1, 3, 4}) {
      SCOPED_TRACE(testing::Message() << name << " " << channels);
      const auto image = noise_image(kWidth, kHeight, channels, 14);
      Node node("color_weight");
      node.set("sigma", 1.4f).set("scale", 0.5f).set("falloff", name).in("image", image);
      check_weight(
          node, kWidth, kHeight,
          [&](int x, int y, int dx, int dy) {
            double squared = 0;
            for (int c = 0; c < channels; ++c)
              squared += std::pow(double(image.at(c, x, y)) - image.at(c, x + dx, y + dy), 2);
            return falloff(name, std::sqrt(squared) / 0.7);
          },
          5e-6);
    }
}

// Guides may be negative, positions for one: these spaces keep the sign.
TEST(ColorWeight, EverySpace) {
  const std::pair<const char*, double (*)(double)> spaces[] = {
      {"linear", [](double x) { return x; }},
      {"log", [](double x) { return std::copysign(std::log1p(std::abs(x)), x); }},
      {"sqrt", [](double x) { return std::copysign(std::sqrt(std::abs(x)), x); }}};
  for (const auto& [name, space] : spaces)
    for (const char* fall : {"gaussian", "exponential", "rational"})
      for (const int channels : {1, 3, 4, 5}) {
        SCOPED_TRACE(testing::Message() << name << " " << fall << " " << channels);
        const auto image = noise_image(kWidth, kHeight, channels, 15, -3, 12);
        Node node("color_weight");
        node.set("sigma", 1.3f).set("space", name).set("falloff", fall).in("image", image);
        check_weight(
            node, kWidth, kHeight,
            [&, of = space](int x, int y, int dx, int dy) {
              double squared = 0;
              for (int c = 0; c < channels; ++c)
                squared += std::pow(of(image.at(c, x, y)) - of(image.at(c, x + dx, y + dy)), 2);
              return falloff(fall, std::sqrt(squared) / 1.3);
            },
            5e-6);
      }
}

}  // namespace
}  // namespace quell::test
