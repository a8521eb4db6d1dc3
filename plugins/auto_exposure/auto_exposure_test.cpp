// auto_exposure: the key is what the frame's logarithmic average becomes.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/run_node.h"

namespace {

using quell::test::constant_image;
using quell::test::Node;
using quell::test::noise_image;

float stops_of(const quell::Image& blocks, float key = 0.18f) {
  return Node("auto_exposure").set("key", key).in("blocks", blocks).run("stops").at(0, 0, 0);
}

TEST(AutoExposure, IsItsFormula) {
  const auto blocks = noise_image(13, 7, 1, 1, 0.01f, 20.0f);
  double sum = 0;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 13; ++x) sum += std::log2(double(blocks.at(0, x, y)));
  EXPECT_NEAR(stops_of(blocks, 0.5f), -1 - sum / (13 * 7), 1e-6);  // rounded to float
}

TEST(AutoExposure, BrighterLightMeansFewerStops) {
  const auto blocks = noise_image(9, 5, 1, 2, 0.1f, 1.0f);
  auto brighter = blocks.copy();
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 9; ++x) brighter.at(0, x, y) *= 8;
  EXPECT_NEAR(stops_of(brighter), stops_of(blocks) - 3, 1e-6);
  EXPECT_NEAR(stops_of(constant_image(3, 3, 1, 0.18f)), 0, 1e-6);
}

TEST(AutoExposure, DarkBlocksDoNotCount) {
  auto blocks = constant_image(4, 4, 1, 0.09f);
  for (int x = 0; x < 4; ++x) blocks.at(0, x, 1) = 0, blocks.at(0, x, 3) = 1e-9f;
  EXPECT_NEAR(stops_of(blocks), 1, 1e-6);
  EXPECT_EQ(stops_of(constant_image(4, 4, 1, 0)), 0.0f);
}

TEST(AutoExposure, ExposesAFrameToItsKey) {
  const auto image = noise_image(67, 41, 3, 4, 0.0f, 30.0f);
  const auto stops =
      Node("auto_exposure").in("blocks", Node("block_average").in("image", image).run("blocks")).run("stops");
  const auto exposed = Node("exposure").in("image", image).in("more", stops).run("image");
  EXPECT_NEAR(stops_of(Node("block_average").in("image", exposed).run("blocks")), 0, 1e-5);
}

}  // namespace
