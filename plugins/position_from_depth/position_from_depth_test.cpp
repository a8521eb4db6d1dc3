// Positions, depths and distances of a camera that looks somewhere, there and back.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <stdexcept>

namespace quell::test {
namespace {

constexpr int kWidth = 33, kHeight = 17;
constexpr double kFocal = 40, kMiddleX = 15, kMiddleY = 9;

// x right, y up, z forward, from a camera that is turned and moved.
glm::dmat4 world_to_view() {
  auto m = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 0.5)));
  m = glm::translate(m, glm::dvec3(-3, 1, 4));
  return m;
}
glm::dmat4 view_to_screen() {  // columns
  return {{kFocal, 0, 0, 0}, {0, -kFocal, 0, 0}, {kMiddleX, kMiddleY, 1, 1}, {0, 0, -0.01, 0}};
}

Image camera() {
  Image table(16, 2, 1);
  const glm::dmat4 both[] = {world_to_view(), view_to_screen() * world_to_view()};
  for (int i = 0; i < 2; ++i)
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) table.at(0, 4 * row + column, i) = float(both[i][column][row]);
  return table;
}

Image depths() {
  auto depth = noise_image(kWidth, kHeight, 1, 94, 2, 30);
  for (int x = 0; x < kWidth; x += 5) depth.at(0, x, 7) = kFar;
  return depth;
}

// What the pixel shows at this depth, in view space.
glm::dvec3 in_view(int x, int y, double z) {
  return {(x + 0.5 - kMiddleX) * z / kFocal, -(y + 0.5 - kMiddleY) * z / kFocal, z};
}

// The camera's matrices are floats, which is 1e-7 of coordinates up to 30.
TEST(PositionFromDepth, IsTheInverseOfTheProjection) {
  const auto table = camera(), depth = depths();
  Node node("position_from_depth");
  const auto out = node.in("depth", depth).in("camera", table).run("position");
  const auto back = glm::inverse(world_to_view());
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double z = depth.at(0, x, y);
      const auto p = z < kFar ? glm::dvec3(back * glm::dvec4(in_view(x, y, z), 1)) : glm::dvec3(0);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(out.at(c, x, y), p[c], 2e-5) << x << "," << y;
    }
}

TEST(PositionFromDepth, NeedsAPinhole) {
  auto table = camera();
  for (int i = 0; i < 4; ++i) table.at(0, 12 + i, 1) = i == 3;
  const auto depth = depths();
  Node node("position_from_depth");
  EXPECT_THROW(node.in("depth", depth).in("camera", table).run("position"), std::runtime_error);
}

TEST(DistanceFromDepth, IsTheLengthOfTheRay) {
  const auto table = camera(), depth = depths();
  Node node("distance_from_depth");
  const auto out = node.in("depth", depth).in("camera", table).run("distance");
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double z = depth.at(0, x, y);
      if (z < kFar)
        ASSERT_NEAR(out.at(0, x, y), glm::length(in_view(x, y, z)), 1e-5) << x << "," << y;
      else
        ASSERT_EQ(out.at(0, x, y), kFar);
    }
}

TEST(DepthFromDistance, UndoesDistanceFromDepth) {
  const auto table = camera(), depth = depths();
  Node there("distance_from_depth"), back("depth_from_distance");
  auto distance = there.in("depth", depth).in("camera", table).run("distance");
  distance.at(0, 1, 1) = 0, distance.at(0, 2, 1) = -1, distance.at(0, 3, 1) = 2e10f;  // all of them misses
  const auto out = back.in("distance", distance).in("camera", table).run("depth");
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool miss = y == 1 && x >= 1 && x <= 3;
      ASSERT_NEAR(out.at(0, x, y), miss ? kFar : depth.at(0, x, y), 5e-6) << x << "," << y;
    }
}

TEST(NormalSpace, TurnsThereAndBack) {
  const auto table = camera(), normal = normal_image(kWidth, kHeight, 95, true);
  Node there("normal_space"), back("normal_space");
  const auto view = there.set("to", "view").in("normal", normal).in("camera", table).run("normal");
  const auto world = back.set("to", "world").in("normal", view).in("camera", table).run("normal");
  const glm::dmat3 turn(world_to_view());
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto expected = turn * glm::dvec3(normal.at(0, x, y), normal.at(1, x, y), normal.at(2, x, y));
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(view.at(c, x, y), expected[c], 1e-6);
        ASSERT_NEAR(world.at(c, x, y), normal.at(c, x, y), 1e-6);
      }
    }
}

}  // namespace
}  // namespace quell::test
