// Motion of still and moving points and of the sky, against their projection.
#include <gtest/gtest.h>
#include <quell/types.h>

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using quell::Image;
using quell::kFar;
using quell::kNoId;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

constexpr int kWidth = 33, kHeight = 17;
constexpr float kNoMotion = 1e6f;

Image table(const std::vector<dmat4>& matrices) {
  Image out(16, int(matrices.size()), 1);
  for (std::size_t i = 0; i < matrices.size(); ++i)
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) out.at(0, 4 * row + column, int(i)) = float(matrices[i][column][row]);
  return out;
}

dmat4 rotation(double angle, dvec3 axis) { return glm::rotate(dmat4(1), angle, glm::normalize(axis)); }

// World to view (x right, y up, z forward) and world to screen of a camera at `eye`.
std::vector<dmat4> camera(dvec3 eye, double yaw, double pitch) {
  const dmat4 view = rotation(pitch, {1, 0, 0}) * rotation(yaw, {0, 1, 0}) * glm::translate(dmat4(1), -eye);
  dmat4 screen(0.0);  // columns
  screen[0][0] = 40, screen[1][1] = -40;
  screen[2] = {kWidth / 2.0, kHeight / 2.0, 1, 1};
  screen[3][2] = -0.01;
  return {view, screen * view};
}

// What the float tables hold, for an oracle that sees the same numbers.
dmat4 rounded(const dmat4& m) {
  dmat4 out;
  for (int c = 0; c < 4; ++c) out[c] = dvec4(glm::vec4(m[c]));
  return out;
}

struct Scene {
  std::vector<dmat4> now = camera({0.2, 0.1, -4}, 0.05, 0.02), then = camera({0.1, 0.15, -4.2}, -0.02, 0.04);
  std::vector<dmat4> objects_now{dmat4(1), rotation(0.4, {0, 0, 1}) * glm::translate(dmat4(1), dvec3(1, 2, 0.5)),
                                 dmat4(1)};
  std::vector<dmat4> objects_then{dmat4(1), rotation(0.1, {0.2, 0, 1}) * glm::translate(dmat4(1), dvec3(0.9, 2, 0.5)),
                                  dmat4(1)};
  Image depth = noise_image(kWidth, kHeight, 1, 1, 2, 6), position{kWidth, kHeight, 3}, id{kWidth, kHeight, 1};

  Scene() {
    const auto pick = noise_image(kWidth, kHeight, 1, 2, 0, 4);
    const dmat4 to_world = glm::inverse(rounded(now[0]));
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double z = depth.at(0, x, y);
        const dvec4 p = to_world * dvec4((x + 0.5 - kWidth / 2.0) * z / 40, -(y + 0.5 - kHeight / 2.0) * z / 40, z, 1);
        const int object = int(pick.at(0, x, y));
        id.bits(0, y)[x] = object == 3 ? kNoId : std::uint32_t(object);
        if (object == 3) depth.at(0, x, y) = kFar;
        for (int c = 0; c < 3; ++c) position.at(c, x, y) = object == 3 ? 0 : float(p[c]);
      }
  }

  // Where pixel (x, y) was.
  glm::dvec2 motion(int x, int y) const {
    const std::uint32_t object = id.bits(0, y)[x];
    dvec4 p(position.at(0, x, y), position.at(1, x, y), position.at(2, x, y), 1);
    if (object == kNoId) {
      const dmat4 turn = glm::inverse(dmat4(glm::dmat3(now[0])));
      p = turn * dvec4((x + 0.5 - kWidth / 2.0) / 40, -(y + 0.5 - kHeight / 2.0) / 40, 1, 0);
    } else {
      p = rounded(objects_then[object]) * glm::inverse(rounded(objects_now[object])) * p;
    }
    const dvec4 s = rounded(then[1]) * p;
    return {s.x / s.w - x - 0.5, s.y / s.w - y - 0.5};
  }

  void expect(const Image& motion_image) const {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        // Positions and matrices are floats: seven digits of numbers below ten, times 40 pixels.
        EXPECT_NEAR(motion_image.at(0, x, y), motion(x, y).x, 2e-4) << x << ',' << y;
        EXPECT_NEAR(motion_image.at(1, x, y), motion(x, y).y, 2e-4) << x << ',' << y;
      }
  }
};

TEST(MotionVectors, GoesBackWithObjectAndCamera) {
  for_each_target([&] {
    const Scene s;
    const auto now = table(s.now), then = table(s.then), objects = table(s.objects_now), before = table(s.objects_then);
    s.expect(Node("motion_vectors")
                 .in("position", s.position)
                 .in("id", s.id)
                 .in("camera", now)
                 .in("camera_before", then)
                 .in("transforms", objects)
                 .in("transforms_before", before)
                 .run("motion"));
    s.expect(Node("motion_vectors")
                 .in("depth", s.depth)
                 .in("id", s.id)
                 .in("camera", now)
                 .in("camera_before", then)
                 .in("transforms", objects)
                 .in("transforms_before", before)
                 .run("motion"));
  });
}

TEST(MotionVectors, TellsMissesByDepthOrPositionAlone) {
  for_each_target([&] {
    Scene s;
    s.objects_now = s.objects_then = {dmat4(1), dmat4(1), dmat4(1)};
    const auto now = table(s.now), then = table(s.then);
    s.expect(Node("motion_vectors").in("depth", s.depth).in("camera", now).in("camera_before", then).run("motion"));
    s.expect(
        Node("motion_vectors").in("position", s.position).in("camera", now).in("camera_before", then).run("motion"));
  });
}

TEST(MotionVectors, AtRestIsZeroToTheBit) {
  for_each_target([&] {
    const Scene s;
    const auto now = table(s.now), objects = table(s.objects_now);
    const auto motion = Node("motion_vectors")
                            .in("position", s.position)
                            .in("id", s.id)
                            .in("camera", now)
                            .in("camera_before", now)
                            .in("transforms", objects)
                            .in("transforms_before", objects)
                            .run("motion");
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) EXPECT_EQ(motion.at(0, x, y), 0);
  });
}

TEST(MotionVectors, LeadsOutOfTheImageWhereNothingIsKnown) {
  for_each_target([&] {
    Scene s;
    const auto now = table(s.now), then = table(s.then), objects = table(s.objects_now);
    const auto fewer = table({s.objects_then[0]});
    const auto motion = Node("motion_vectors")
                            .in("position", s.position)
                            .in("id", s.id)
                            .in("camera", now)
                            .in("camera_before", then)
                            .in("transforms", objects)
                            .in("transforms_before", fewer)
                            .run("motion");
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto object = s.id.bits(0, y)[x];
        EXPECT_EQ(motion.at(0, x, y) == kNoMotion, object == 1 || object == 2) << x << ',' << y;
      }

    const auto first = Node("motion_vectors")
                           .in("position", s.position)
                           .in("camera", now)
                           .in_missing("camera_before", now)
                           .run("motion");
    EXPECT_EQ(first.at(1, 3, 3), kNoMotion);

    const auto turned = table(camera({0.2, 0.1, -4}, 3.1, 0.02));  // the previous camera looked the other way
    const auto behind =
        Node("motion_vectors").in("position", s.position).in("camera", now).in("camera_before", turned).run("motion");
    EXPECT_EQ(behind.at(0, 16, 8), kNoMotion);
  });
}

TEST(MotionVectors, SaysWhatIsMissing) {
  const Scene s;
  const auto now = table(s.now), objects = table(s.objects_now);
  const auto error = [](Node& node) -> std::string {
    try {
      node.run("motion");
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error(Node("motion_vectors").in("id", s.id).in("camera", now).in("camera_before", now)),
            "connect position or depth");
  EXPECT_EQ(error(Node("motion_vectors")
                      .in("depth", s.depth)
                      .in("camera", now)
                      .in("camera_before", now)
                      .in("transforms", objects)
                      .in("transforms_before", objects)),
            "transforms need id, to tell which matrix moves a pixel");
}

}  // namespace
