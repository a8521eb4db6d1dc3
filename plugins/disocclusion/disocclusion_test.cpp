// Validation of reprojected taps against a direct evaluation of the rules.
#include <gtest/gtest.h>
#include <quell/types.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::kFar;
using quell::kNoId;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;
using quell::test::normal_image;

constexpr std::uint32_t kWhole = 1u << 9;

// A frame with three objects, edges in depth, and sky in its upper half.
struct Frame {
  Image depth, normal, id, slope;

  Frame(int width, int height, int shift) : depth(width, height, 1), id(width, height, 1), slope(width, height, 2) {
    normal = normal_image(width, height, 5);
    slope.fill(0.01f);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int object = (x + shift) / 5 % (2 * y < height ? 4 : 3);
        depth.at(0, x, y) = object == 3 ? kFar : 2.0f + float(object) + 0.02f * float(y);
        id.bits(0, y)[x] = object == 3 ? kNoId : std::uint32_t(object);
        if (object == 3)
          for (int c = 0; c < 3; ++c) normal.at(c, x, y) = 0;
      }
  }
};

struct Rules {
  double depth_tolerance = 10, depth_floor = double(0.01f), normal_cosine = double(0.9f);
};

bool sky(const Image& normal, int x, int y) {
  return normal.at(0, x, y) == 0 && normal.at(1, x, y) == 0 && normal.at(2, x, y) == 0;
}

bool agree(const Frame& now, int x, int y, const Frame& then, int u, int v, const Rules& r) {
  if (u < 0 || v < 0 || u >= then.id.width() || v >= then.id.height()) return false;
  if (now.id.bits(0, y)[x] != then.id.bits(0, v)[u]) return false;
  const double z = now.depth.at(0, x, y), z_then = then.depth.at(0, u, v);
  const bool far = z > 1e29, far_then = z_then > 1e29;
  if (far != far_then) return false;
  const double slope = std::abs(now.slope.at(0, x, y)) + std::abs(now.slope.at(1, x, y));
  if (!far && std::abs(z - z_then) > r.depth_tolerance * (slope + r.depth_floor * z)) return false;
  if (sky(now.normal, x, y) != sky(then.normal, u, v)) return false;
  double cosine = 0;
  for (int c = 0; c < 3; ++c) cosine += double(now.normal.at(c, x, y)) * then.normal.at(c, u, v);
  return sky(now.normal, x, y) || cosine >= r.normal_cosine;
}

Node disocclusion(const Frame& now, const Frame& then, const Image& motion) {
  return std::move(Node("disocclusion")
                       .in("motion", motion)
                       .in("slope", now.slope)
                       .in("depth", now.depth)
                       .in("depth_before", then.depth)
                       .in("normal", now.normal)
                       .in("normal_before", then.normal)
                       .in("id", now.id)
                       .in("id_before", then.id));
}

TEST(Disocclusion, FollowsItsRules) {
  for_each_target([&] {
    const int width = 101, height = 19;
    const Frame now(width, height, 0), then(width, height, 3);
    // Quarters of a pixel, so that positions and weights are the same in float and double. Where they change slowly,
    // the positions of a vector lie in one line, in two or in more; where they are noise, anywhere.
    auto motion = noise_image(width, height, 2, 11, -12, 12);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (y % 2) motion.at(0, x, y) = float(x / 6 - 8), motion.at(1, x, y) = float((x + 2 * y) / 11 - 6);
        for (int c = 0; c < 2; ++c) motion.at(c, x, y) = std::round(motion.at(c, x, y)) / 4;
      }

    for (const bool nearest : {false, true})
      for (const bool fallback : {true, false}) {
        Rules rules;
        if (!fallback) rules.normal_cosine = -0.25;
        const auto taps = disocclusion(now, then, motion)
                              .set("mode", nearest ? "nearest" : "bilinear")
                              .set("fallback", fallback)
                              .set("normal_cosine", float(rules.normal_cosine))
                              .run("taps");
        int partial = 0, whole = 0, only_around = 0;
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            SCOPED_TRACE(testing::Message()
                         << x << ',' << y << (nearest ? " nearest" : "") << (fallback ? " fallback" : ""));
            // The continuous position of the pixel's centre, one frame earlier.
            const double sx = x + 0.5 + motion.at(0, x, y), sy = y + 0.5 + motion.at(1, x, y);
            const bool inside = sx >= 0 && sy >= 0 && sx < width && sy < height;
            const int nx = int(std::floor(sx)), ny = int(std::floor(sy));
            const int bx = int(std::floor(sx - 0.5)), by = int(std::floor(sy - 0.5));
            double weight[4] = {}, sum = 0;
            std::uint32_t mask = 0, count = 0;
            if (inside) {
              for (int t = 0; t < 4; ++t) {
                const int u = bx + t % 2, v = by + t / 2;
                const double w =
                    nearest ? double(u == nx && v == ny) : (1 - std::abs(sx - 0.5 - u)) * (1 - std::abs(sy - 0.5 - v));
                if (agree(now, x, y, then, u, v, rules)) sum += weight[t] = w;
              }
              for (int t = 0; t < 9; ++t)
                if (agree(now, x, y, then, nx + t % 3 - 1, ny + t / 3 - 1, rules)) mask |= 1u << t;
              for (int t = 0; t < 16; ++t) count += agree(now, x, y, then, bx - 1 + t % 4, by - 1 + t / 4, rules);
              if (count == 16) mask |= kWhole;
            }
            if (sum < 0.01 && !fallback) mask = 0;
            for (int t = 0; t < 4; ++t) EXPECT_NEAR(taps.at(t, x, y), sum < 0.01 ? 0 : weight[t] / sum, 1e-6);
            EXPECT_EQ(taps.bits(4, y)[x], mask);
            partial += sum >= 0.01 && sum < 0.99, whole += count == 16, only_around += sum < 0.01 && mask != 0;
          }
        EXPECT_GT(whole, 5);
        if (!nearest) {
          EXPECT_GT(partial, 5);
        }
        if (fallback) {
          EXPECT_GT(only_around, 5);
        }
      }
  });
}

TEST(Disocclusion, WithoutMotionAndChangeIsCertainEverywhere) {
  for_each_target([&] {
    const Frame frame(17, 9, 0);
    const auto taps = disocclusion(frame, frame, constant_image(17, 9, 2, 0)).run("taps");
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 17; ++x) {
        EXPECT_EQ(taps.at(0, x, y), 1);
        for (int t = 1; t < 4; ++t) EXPECT_EQ(taps.at(t, x, y), 0);
      }
  });
}

TEST(Disocclusion, TestsDepthWithinSlopeAndFloor) {
  for_each_target([&] {
    const auto motion = constant_image(3, 1, 2, 0), now = constant_image(3, 1, 1, 4);
    auto slope = constant_image(3, 1, 2, 0.0f), then = constant_image(3, 1, 1, 4.5f);
    slope.at(0, 1, 0) = -0.05f;
    then.at(0, 2, 0) = 4.3f;
    const auto taps = Node("disocclusion")
                          .in("motion", motion)
                          .in("slope", slope)
                          .in("depth", now)
                          .in("depth_before", then)
                          .set("fallback", false)
                          .run("taps");
    EXPECT_EQ(taps.at(0, 0, 0), 0) << "0.5 apart, 0.4 allowed";
    EXPECT_EQ(taps.at(0, 1, 0), 1) << "0.5 apart, 0.9 allowed";
    EXPECT_EQ(taps.at(0, 2, 0), 1) << "0.3 apart, 0.4 allowed";
  });
}

TEST(Disocclusion, TestsPositionsAgainstThePlane) {
  for_each_target([&] {
    const int width = 61, height = 13;
    const auto motion = constant_image(width, height, 2, 0), slope = constant_image(width, height, 2, 0);
    const auto depth = constant_image(width, height, 1, 5);
    const auto normal = normal_image(width, height, 5, true);
    // Normals then are those of now, but for every seventh, which is a miss.
    auto then = normal.copy();
    for (int y = 0; y < height; ++y)
      for (int x = y % 7; x < width; x += 7)
        for (int c = 0; c < 3; ++c) then.at(c, x, y) = 0;
    const auto position = noise_image(width, height, 3, 7, -4, 4),
               position_before = noise_image(width, height, 3, 8, -4, 4);
    const float tolerance = 0.25f;
    const auto taps = Node("disocclusion")
                          .in("motion", motion)
                          .in("slope", slope)
                          .in("depth", depth)
                          .in("depth_before", depth)
                          .in("normal", normal)
                          .in("normal_before", then)
                          .in("position", position)
                          .in("position_before", position_before)
                          .set("plane_tolerance", tolerance)
                          .set("fallback", false)
                          .run("taps");
    int near = 0, away = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double distance = 0;
        for (int c = 0; c < 3; ++c)
          distance += double(normal.at(c, x, y)) * (double(position_before.at(c, x, y)) - position.at(c, x, y));
        const bool alike = sky(normal, x, y) == sky(then, x, y);
        const bool valid = alike && std::abs(distance) <= double(tolerance) * 5;
        EXPECT_EQ(taps.at(0, x, y), valid ? 1 : 0) << x << ',' << y << ": " << distance;
        near += valid, away += alike && !valid;
      }
    EXPECT_GT(near, 50);
    EXPECT_GT(away, 50);
  });
}

TEST(Disocclusion, OfPositionsWantsThePlaneToo) {
  const auto motion = constant_image(3, 3, 2, 0), position = constant_image(3, 3, 3, 1);
  try {
    Node("disocclusion").in("motion", motion).in("position", position).in("position_before", position).run("taps");
    FAIL() << "no error";
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(),
                 "position is tested against the plane of the surface, which takes normal and depth: connect both, or "
                 "leave position unconnected");
  }
}

TEST(Disocclusion, WithoutHistoryOrInsideIsNothing) {
  for_each_target([&] {
    const Frame frame(9, 5, 0);
    const auto still = constant_image(9, 5, 2, 0), far = constant_image(9, 5, 2, 1e6f),
               wild = constant_image(9, 5, 2, NAN);
    const auto first =
        Node("disocclusion").in("motion", still).in("id", frame.id).in_missing("id_before", frame.id).run("taps");
    const auto out = disocclusion(frame, frame, far).run("taps"), nan = disocclusion(frame, frame, wild).run("taps");
    for (const auto* taps : {&first, &out, &nan})
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) {
          for (int t = 0; t < 4; ++t) EXPECT_EQ(taps->at(t, x, y), 0);
          EXPECT_EQ(taps->bits(4, y)[x], 0u);
        }
  });
}

TEST(Disocclusion, WantsGuidesInPairs) {
  const auto motion = constant_image(3, 3, 2, 0), depth = constant_image(3, 3, 1, 1);
  try {
    Node("disocclusion").in("motion", motion).in("depth", depth).run("taps");
    FAIL() << "no error";
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(), "depth and depth_before go together: one is connected and the other is not");
  }
}

}  // namespace
