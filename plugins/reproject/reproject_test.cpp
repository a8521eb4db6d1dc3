// Fetching history along motion, through taps that disocclusion made.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

struct Guides {
  Image motion, id, id_before, taps;

  // Objects are 0 and 1, at random. Motion is noise, and in odd rows smooth, so that the positions of a vector lie in a
  // few lines.
  Guides(int width, int height, float reach)
      : motion(noise_image(width, height, 2, 3, -reach, reach)), id(width, height, 1), id_before(width, height, 1) {
    const auto now = noise_image(width, height, 1, 4), then = noise_image(width, height, 1, 5);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        id.bits(0, y)[x] = now.at(0, x, y) < 0.5f;
        id_before.bits(0, y)[x] = then.at(0, x, y) < 0.5f;
      }
    for (int y = 1; y < height; y += 2)
      for (int x = 0; x < width; ++x)
        motion.at(0, x, y) = 0.03f * float(x) - 1, motion.at(1, x, y) = 0.5f - 0.04f * float(x + y);
    taps = Node("disocclusion").in("motion", motion).in("id", id).in("id_before", id_before).run("taps");
  }
};

TEST(Reproject, AveragesTheValidTaps) {
  for_each_target([&] {
    const int width = 101, height = 19;
    Guides s(width, height, 4);
    const auto before = noise_image(width, height, 3, 9);
    const auto out = Node("reproject").in("image", before).in("motion", s.motion).in("taps", s.taps).run("image");
    int bilinear = 0, around = 0, none = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float px = float(x) + s.motion.at(0, x, y), py = float(y) + s.motion.at(1, x, y);
        const bool inside = px >= -0.5f && py >= -0.5f && px < float(width) - 0.5f && py < float(height) - 0.5f;
        const int bx = int(std::floor(px)), by = int(std::floor(py));
        const int nx = int(std::floor(px + 0.5f)), ny = int(std::floor(py + 0.5f));
        const auto valid = [&](int u, int v) {
          return u >= 0 && v >= 0 && u < width && v < height && s.id_before.bits(0, v)[u] == s.id.bits(0, y)[x];
        };
        for (int c = 0; c < 3; ++c) {
          double sum = 0, total = 0;
          if (inside)
            for (int t = 0; t < 4; ++t) {
              const int u = bx + t % 2, v = by + t / 2;
              const double w = (1 - std::abs(double(px) - u)) * (1 - std::abs(double(py) - v));
              if (valid(u, v)) sum += w * before.at(c, u, v), total += w;
            }
          bool fell_back = false;
          if (inside && total < 0.01) {
            sum = total = 0;
            for (int t = 0; t < 9; ++t)
              if (valid(nx + t % 3 - 1, ny + t / 3 - 1)) sum += before.at(c, nx + t % 3 - 1, ny + t / 3 - 1), ++total;
            fell_back = true;
          }
          EXPECT_NEAR(out.at(c, x, y), total > 0 ? sum / total : 0, 1e-5) << x << ',' << y;
          bilinear += total > 0 && !fell_back, around += total > 0 && fell_back, none += total == 0;
        }
      }
    EXPECT_GT(bilinear, 100);
    EXPECT_GT(around, 10);
    EXPECT_GT(none, 10);
  });
}

TEST(Reproject, WithoutMotionIsTheIdentityToTheBit) {
  for_each_target([&] {
    const auto motion = constant_image(17, 5, 2, 0), before = noise_image(17, 5, 4, 2, -1e6f, 1e6f);
    const auto taps = Node("disocclusion").in("motion", motion).run("taps");
    for (const char* filter : {"bilinear", "nearest", "catmull_rom"}) {
      const auto out = Node("reproject")
                           .set("filter", filter)
                           .in("image", before)
                           .in("motion", motion)
                           .in("taps", taps)
                           .run("image");
      for (int c = 0; c < 4; ++c)
        for (int y = 0; y < 5; ++y)
          for (int x = 0; x < 17; ++x) EXPECT_EQ(out.at(c, x, y), before.at(c, x, y)) << filter;
    }
  });
}

// Catmull-Rom's cubic through four values, at t beyond the second.
double cubic(double t, const double v[4]) {
  return 0.5 * (2 * v[1] + (v[2] - v[0]) * t + (2 * v[0] - 5 * v[1] + 4 * v[2] - v[3]) * t * t +
                (3 * v[1] - v[0] - 3 * v[2] + v[3]) * t * t * t);
}

TEST(Reproject, CubicWeightsAreCatmullRoms) {
  // Values around an inner pair of 0 and 10 that do not leave its range: the result is the sum of weights times values.
  for (const auto& [t, weight] : {std::pair{0.25, std::array{-.0703125, .8671875, .2265625, -.0234375}},
                                  std::pair{0.5, std::array{-.0625, .5625, .5625, -.0625}}})
    for (int k = 0; k < 4; ++k) {
      double v[4] = {0, 0, 10, 0};
      v[k] += 1;
      EXPECT_NEAR(cubic(t, v), 10 * weight[2] + weight[std::size_t(k)], 1e-12);
      for_each_target([&, t = t, weight = weight] {
        auto before = constant_image(9, 9, 1, 0);
        for (int y = 0; y < 9; ++y)
          for (int i = 0; i < 4; ++i) before.at(0, 3 + i, y) = float(v[i]);
        auto motion = constant_image(9, 9, 2, 0);
        motion.at(0, 4, 4) = float(t);
        const auto taps = Node("disocclusion").in("motion", motion).run("taps");
        const auto out = Node("reproject")
                             .set("filter", "catmull_rom")
                             .in("image", before)
                             .in("motion", motion)
                             .in("taps", taps)
                             .run("image");
        EXPECT_NEAR(out.at(0, 4, 4), 10 * weight[2] + weight[std::size_t(k)], 2e-6);
      });
    }
}

TEST(Reproject, CubicWhereAllAreValidAndElseBilinear) {
  for_each_target([&] {
    const int width = 101, height = 19;
    Guides s(width, height, 4);
    // Large objects, so that some footprints are whole.
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) s.id.bits(0, y)[x] = s.id_before.bits(0, y)[x] = x > 60;
    s.taps = Node("disocclusion").in("motion", s.motion).in("id", s.id).in("id_before", s.id_before).run("taps");
    const auto before = noise_image(width, height, 3, 9);
    const auto warp = [&](const char* filter) {
      return Node("reproject")
          .set("filter", filter)
          .in("image", before)
          .in("motion", s.motion)
          .in("taps", s.taps)
          .run("image");
    };
    const auto out = warp("catmull_rom"), bilinear = warp("bilinear");
    int whole = 0, held = 0, partial = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float px = float(x) + s.motion.at(0, x, y), py = float(y) + s.motion.at(1, x, y);
        const int bx = int(std::floor(px)), by = int(std::floor(py));
        bool all = bx >= 1 && by >= 1 && bx + 2 < width && by + 2 < height;
        for (int t = 0; all && t < 16; ++t)
          all = s.id_before.bits(0, by - 1 + t / 4)[bx - 1 + t % 4] == s.id.bits(0, y)[x];
        for (int c = 0; c < 3; ++c) {
          if (!all) {
            EXPECT_EQ(out.at(c, x, y), bilinear.at(c, x, y)) << x << ',' << y;
            ++partial;
            continue;
          }
          double line[4], low = 1e9, high = -1e9;
          for (int j = 0; j < 4; ++j) {
            double v[4];
            for (int i = 0; i < 4; ++i) {
              v[i] = before.at(c, bx - 1 + i, by - 1 + j);
              if (i % 3 && j % 3) low = std::min(low, v[i]), high = std::max(high, v[i]);
            }
            line[j] = cubic(double(px) - bx, v);
          }
          const double free = cubic(double(py) - by, line);
          EXPECT_NEAR(out.at(c, x, y), std::clamp(free, low, high), 5e-6) << x << ',' << y;
          ++whole, held += free < low || free > high;
        }
      }
    EXPECT_GT(whole, 500);
    EXPECT_GT(held, 50);
    EXPECT_GT(partial, 100);
  });
}

TEST(Reproject, NearestTakesTheLargestTapAlone) {
  for_each_target([&] {
    const int width = 101, height = 19;
    const Guides s(width, height, 4);
    const auto before = noise_image(width, height, 2, 9);
    const auto out = Node("reproject")
                         .set("filter", "nearest")
                         .in("image", before)
                         .in("motion", s.motion)
                         .in("taps", s.taps)
                         .run("image");
    int checked = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int bx = int(std::floor(float(x) + s.motion.at(0, x, y))),
                  by = int(std::floor(float(y) + s.motion.at(1, x, y)));
        int best = 3;
        for (int t = 2; t >= 0; --t)
          if (s.taps.at(t, x, y) > s.taps.at(best, x, y)) best = t;
        if (s.taps.at(best, x, y) == 0) continue;
        for (int c = 0; c < 2; ++c) EXPECT_EQ(out.at(c, x, y), before.at(c, bx + best % 2, by + best / 2));
        ++checked;
      }
    EXPECT_GT(checked, 500);
  });
}

TEST(Reproject, FarOutOfTheImageIsNothing) {
  for_each_target([&] {
    const auto motion = constant_image(41, 5, 2, 1e6f), before = noise_image(41, 5, 3, 2);
    const auto taps = constant_image(41, 5, 5, 0.25f);  // that do not belong to this motion
    const auto out = Node("reproject").in("image", before).in("motion", motion).in("taps", taps).run("image");
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 41; ++x) EXPECT_EQ(out.at(0, x, y), 0);
  });
}

TEST(Reproject, KeepsWhatIsConstant) {
  for_each_target([&] {
    Guides s(23, 11, 2);
    const auto before = constant_image(23, 11, 1, 0.7f);
    const auto out = Node("reproject").in("image", before).in("motion", s.motion).in("taps", s.taps).run("image");
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 23; ++x) EXPECT_NEAR(out.at(0, x, y), out.at(0, x, y) == 0 ? 0 : 0.7f, 3e-7);
  });
}

}  // namespace
