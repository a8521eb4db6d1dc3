// The joint bilateral filter of GAMES202 homework 5, as window and three weight nodes, on the published box sequence.
//
// The values are those of the formula in double precision on frame 0: pixel metric, radius 16, sigmas 32 (pixels), 0.6
// (colour), 0.1 (normal, radians) and 0.1 (plane), taps outside the image dropped, the arc-cosine's argument in [0,1].
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace quell::test {
namespace {

Image read(const std::string& path) {
  const auto file = OIIO::ImageInput::open(path);
  if (!file) throw std::runtime_error(path + ": " + OIIO::geterror());
  const auto& spec = file->spec();
  Image image(spec.width, spec.height, spec.nchannels);
  for (int c = 0; c < spec.nchannels; ++c)
    for (int y = 0; y < spec.height; ++y)
      if (!file->read_scanlines(0, 0, spec.y + y, spec.y + y + 1, 0, c, c + 1, OIIO::TypeDesc::FLOAT, image.row(c, y)))
        throw std::runtime_error(path + ": " + file->geterror());
  return image;
}

TEST(Games202, JointBilateralFilter) {
  const char* data = std::getenv("QUELL_TEST_DATA");
  if (!data) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  const std::string folder = std::string(data) + "/games202-box/";
  const auto beauty = read(folder + "beauty_0.exr"), normal = read(folder + "normal_0.exr");
  const auto position = read(folder + "position_0.exr");
  ASSERT_EQ(beauty.width(), 512);
  Node by_color("color_weight"), by_normal("normal_weight"), by_plane("plane_weight"), window("window");
  by_color.set("sigma", 0.6f).in("image", beauty);
  by_normal.set("mode", "angle").set("sigma", 0.1f).in("normal", normal);
  by_plane.set("mode", "sine").set("sigma", 0.1f).in("normal", normal).in("position", position);
  window.set("radius", 16).set("sigma", 32.0f).in("image", beauty);
  window.in("weights", by_color).in("weights", by_normal).in("weights", by_plane);
  const auto out = window.run("image");
  struct Golden {
    int x, y;
    double rgb[3];
  };
  for (const Golden& golden : {Golden{256, 256, {.009255, .007756, .005192}},
                               {100, 300, {.100471, .069315, .061245}},
                               {200, 400, {.101310, .082793, .070497}},
                               {256, 100, {.062437, .053429, .039987}},
                               {10, 10, {.029745, .020294, .015539}},
                               {330, 380, {.090479, .084951, .067514}},
                               {60, 256, {.133121, .013711, .009577}},
                               {256, 40, {.016596, .013258, .008771}}})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(out.at(c, golden.x, golden.y), golden.rgb[c], 2e-5)
          << golden.x << "," << golden.y << " channel " << c;
  // Background has no normal and is black: it must stay so, and finite.
  int background = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      if (normal.at(0, x, y) != 0 || normal.at(1, x, y) != 0 || normal.at(2, x, y) != 0) continue;
      ++background;
      for (int c = 0; c < 3; ++c) ASSERT_EQ(out.at(c, x, y), 0.0f) << x << "," << y;
    }
  EXPECT_EQ(background, 14140);
}

}  // namespace
}  // namespace quell::test
