// color_transform against matrices made from chromaticities, and its words for what it cannot do.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include <glm/glm.hpp>

#include "tests/support/failure.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::Node;
using quell::test::noise_image;
using quell::test::Scratch;

// The machine's own configuration is none of the tests' business.
class ColorTransform : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("OCIO"); }
};

glm::dvec3 xyz(glm::dvec2 c) { return {c.x / c.y, 1, (1 - c.x - c.y) / c.y}; }

// RGB to CIE XYZ of primaries and a white (SMPTE RP 177).
glm::dmat3 to_xyz(glm::dvec2 r, glm::dvec2 g, glm::dvec2 b, glm::dvec2 white) {
  const glm::dmat3 primaries(xyz(r), xyz(g), xyz(b));
  const auto scale = glm::inverse(primaries) * xyz(white);
  return {primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]};
}

// Bradford's adaptation from one white to another.
glm::dmat3 adapted(glm::dvec2 from, glm::dvec2 to) {
  const auto bradford =
      glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
  const auto gain = (bradford * xyz(to)) / (bradford * xyz(from));
  return glm::inverse(bradford) * glm::dmat3(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z) * bradford;
}

const glm::dvec2 kD65{0.3127, 0.3290}, kAcesWhite{0.32168, 0.33767};

glm::dmat3 rec709_to(glm::dvec2 r, glm::dvec2 g, glm::dvec2 b) {
  const auto rec709 = to_xyz({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65);
  return glm::inverse(to_xyz(r, g, b, kAcesWhite)) * adapted(kD65, kAcesWhite) * rec709;
}
glm::dmat3 rec709_to_acescg() { return rec709_to({0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}); }
glm::dmat3 rec709_to_ap0() { return rec709_to({0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}); }

void expect_matrix(const Image& in, const Image& out, const glm::dmat3& matrix) {
  for (int y = 0; y < in.height(); ++y)
    for (int x = 0; x < in.width(); ++x) {
      const auto v = matrix * glm::dvec3(in.at(0, x, y), in.at(1, x, y), in.at(2, x, y));
      // Published matrices have seven digits or so, and three products are summed as floats.
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(out.at(c, x, y), std::max(v[c], 0.0), 5e-6 * (1 + glm::length(v)));
    }
}

TEST_F(ColorTransform, IsTheMatrixOfThePrimaries) {
  const auto image = noise_image(67, 9, 3, 1, 0.0f, 20.0f);
  expect_matrix(image, Node("color_transform").in("image", image).run("image"), rec709_to_acescg());
  expect_matrix(image, Node("color_transform").set("to", "ACES2065-1").in("image", image).run("image"),
                rec709_to_ap0());
  expect_matrix(image,
                Node("color_transform").set("from", "ACEScg").set("to", "lin_rec709").in("image", image).run("image"),
                glm::inverse(rec709_to_acescg()));
}

TEST_F(ColorTransform, GoesThereAndBack) {
  const auto image = noise_image(67, 9, 3, 2, 0.0f, 20.0f);
  const auto wide = Node("color_transform").in("image", image).run("image");
  const auto back =
      Node("color_transform").set("from", "ACEScg").set("to", "scene_linear").in("image", wide).run("image");
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 67; ++x)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(back.at(c, x, y), image.at(c, x, y), 2e-5);
}

TEST_F(ColorTransform, WhatIsOutsideTheGamutIsNotNegative) {
  auto green = constant_image(3, 1, 3, 0);
  for (int x = 0; x < 3; ++x) green.at(1, x, 0) = 1;
  const auto out =
      Node("color_transform").set("from", "ACEScg").set("to", "lin_rec709").in("image", green).run("image");
  EXPECT_EQ(out.at(0, 1, 0), 0.0f);
  EXPECT_GT(out.at(1, 1, 0), 1.0f);
}

std::string failure(Node& node) {
  return quell::test::failure([&] { node.run("image"); });
}

TEST_F(ColorTransform, ListsTheSpacesThatThereAre) {
  const auto image = constant_image(3, 3, 3, 1);
  EXPECT_EQ(failure(Node("color_transform").set("to", "ACESgc").in("image", image)),
            "to: the built-in configuration has no color space 'ACESgc'\n"
            "  it has: ACES2065-1, ACEScg, Linear Rec.709 (sRGB), sRGB - Display. Did you mean 'ACEScg'?");
}

constexpr const char* kHalving = R"(ocio_profile_version: 2
roles: {default: scene, scene_linear: scene}
file_rules: [!<Rule> {name: Default, colorspace: default}]
displays: {screen: [!<View> {name: plain, colorspace: half}]}
colorspaces:
  - !<ColorSpace> {name: scene}
  - !<ColorSpace>
    name: half
    from_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
)";

TEST_F(ColorTransform, TakesTheConfigurationOfAFileOrOfTheEnvironment) {
  const Scratch scratch;
  std::ofstream(scratch.path("halving.ocio")) << kHalving;
  const auto image = noise_image(9, 3, 3, 3);
  const auto by_file = Node("color_transform")
                           .set("config", scratch.path("halving.ocio"))
                           .set("to", "half")
                           .in("image", image)
                           .run("image");
  setenv("OCIO", scratch.path("halving.ocio").c_str(), 1);
  const auto by_variable = Node("color_transform").set("to", "half").in("image", image).run("image");
  unsetenv("OCIO");
  EXPECT_EQ(by_file.at(1, 4, 2), 0.5f * image.at(1, 4, 2));
  EXPECT_TRUE(quell::test::same_bits(by_file, by_variable));
}

TEST_F(ColorTransform, SaysWhatIsWrongWithAFile) {
  const Scratch scratch;
  const auto image = constant_image(3, 3, 3, 1);
  const auto bad = scratch.path("bad.ocio"), none = scratch.path("none.ocio");
  std::ofstream(bad) << "ocio_profile_version: 2\ncolorspaces: [";
  EXPECT_TRUE(failure(Node("color_transform").set("config", bad).in("image", image))
                  .starts_with("cannot use the OpenColorIO configuration '" + bad + "': "));
  setenv("OCIO", none.c_str(), 1);
  const auto text = failure(Node("color_transform").in("image", image));
  unsetenv("OCIO");
  EXPECT_TRUE(text.starts_with("cannot use the OpenColorIO configuration '" + none + "', which $OCIO names: ")) << text;
}

}  // namespace
