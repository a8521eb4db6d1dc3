// display_transform: the plain view is the sRGB curve, the ACES view keeps what ACES says of grey.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/support/failure.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::Node;
using quell::test::noise_image;

class DisplayTransform : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("OCIO"); }
};

double srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

TEST_F(DisplayTransform, ThePlainViewIsTheCurveOfSrgb) {
  const auto image = noise_image(67, 9, 3, 1, 0.0f, 1.2f);
  const auto out = Node("display_transform").set("view", "Un-tone-mapped").in("image", image).run("image");
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 67; ++x)
      for (int c = 0; c < 3; ++c)
        // A matrix from Rec. 709 and one back leave 1e-6, which the curve steepens up to 12.92 times near black; the
        // linear part of its published constants meets the power to 1e-5.
        ASSERT_NEAR(out.at(c, x, y), srgb(std::clamp(double(image.at(c, x, y)), 0.0, 1.0)), 3e-5) << x << "," << y;
}

TEST_F(DisplayTransform, TheAcesViewIsTheDefaultAndShowsGreyAsAcesSays) {
  Image image(66, 1, 3);
  for (int x = 0; x < 66; ++x)
    for (int c = 0; c < 3; ++c) image.at(c, x, 0) = x == 0 ? 0.0f : x == 65 ? 0.18f : std::exp2(0.5f * float(x) - 24);
  const auto out = Node("display_transform").in("image", image).run("image");
  const auto named = Node("display_transform").set("view", "ACES 1.0 - SDR Video").in("image", image).run("image");
  EXPECT_TRUE(quell::test::same_bits(out, named));
  // Mid grey is 4.8 of 48 cd/m², black 0.02; the surround of a screen takes luminance to the power 0.9811
  // (Academy TB-2014-004 and ODT.Academy.sRGB_100nits_dim).
  const double grey = std::pow((4.8 - 0.02) / (48 - 0.02), 0.9811);
  EXPECT_NEAR(out.at(0, 65, 0), srgb(grey), 1e-3);
  for (int x = 0; x < 66; ++x)
    for (int c = 1; c < 3; ++c) EXPECT_NEAR(out.at(c, x, 0), out.at(0, x, 0), 1e-4) << "grey stays grey";
  EXPECT_NEAR(out.at(1, 0, 0), 0, 1e-6);
  for (int x = 1; x < 65; ++x) EXPECT_GE(out.at(1, x, 0), out.at(1, x - 1, 0) - 1e-6f) << x;
  EXPECT_NEAR(out.at(1, 64, 0), 1, 1e-6);
}

std::string failure(Node& node) {
  return quell::test::failure([&] { node.run("image"); });
}

TEST_F(DisplayTransform, ListsWhatThereIs) {
  const auto image = constant_image(3, 3, 3, 1);
  EXPECT_EQ(failure(Node("display_transform").set("display", "srgb").in("image", image)),
            "display: the built-in configuration has no display 'srgb'\n  it has: sRGB - Display");
  EXPECT_EQ(failure(Node("display_transform").set("view", "un-tonemapped").in("image", image)),
            "view: display 'sRGB - Display' of the built-in configuration has no view 'un-tonemapped'\n"
            "  it has: ACES 1.0 - SDR Video, Un-tone-mapped. Did you mean 'Un-tone-mapped'?");
  EXPECT_TRUE(failure(Node("display_transform").set("from", "rec709").in("image", image))
                  .starts_with("from: the built-in configuration has no color space 'rec709'"));
}

}  // namespace
