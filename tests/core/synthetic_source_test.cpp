// Frames made for timing keep the conventions of <quell/types.h>, as frames of a renderer do.
#include "core/bench/synthetic_source.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <cmath>
#include <cstring>
#include <set>

namespace quell {
namespace {

constexpr int kWidth = 96, kHeight = 61;

bool same(const Image& a, const Image& b) {
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * sizeof(float))) return false;
  return true;
}

template <class F>
void each(const Image& image, F&& f) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) f(x, y);
}

TEST(Synthetic, EveryTypeIsFiniteAtEverySize) {
  for (const auto& type : kTypes) {
    if (type.storage == Storage::none || type.integer) continue;
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 9}, {17, 3}, {kWidth, kHeight}}) {
      const auto image = synthetic_image(type.type, w, h, 1);
      if (type.channels) {
        EXPECT_EQ(image.channels(), type.channels) << type.name;
      }
      if (type.storage == Storage::pixels) {
        EXPECT_TRUE(image.width() == w && image.height() == h) << type.name;
      }
      const int floats = type.type == QUELL_TAPS ? 4 : image.channels();
      each(image, [&](int x, int y) {
        for (int c = 0; c < floats; ++c) ASSERT_TRUE(std::isfinite(image.at(c, x, y))) << type.name;
      });
    }
  }
}

TEST(Synthetic, SurfacesAndSkyAgreeAcrossTypes) {
  const auto normal = synthetic_image(QUELL_NORMAL, kWidth, kHeight, 0);
  const auto depth = synthetic_image(QUELL_DEPTH, kWidth, kHeight, 0);
  const auto id = synthetic_image(QUELL_ID, kWidth, kHeight, 0);
  const auto position = synthetic_image(QUELL_POSITION, kWidth, kHeight, 0);
  const auto objects = synthetic_image(QUELL_TRANSFORMS, kWidth, kHeight, 0).height();
  int sky = 0;
  std::set<std::uint32_t> ids;
  each(depth, [&](int x, int y) {
    const bool miss = id.bits(0, y)[x] == kNoId;
    float length = 0;
    for (int c = 0; c < 3; ++c) length += normal.at(c, x, y) * normal.at(c, x, y);
    if (miss) {
      ++sky;
      ASSERT_EQ(depth.at(0, x, y), kFar);
      ASSERT_EQ(length, 0);
    } else {
      ids.insert(id.bits(0, y)[x]);
      ASSERT_NEAR(length, 1, 1e-5);
      ASSERT_GT(depth.at(0, x, y), 0);
      ASSERT_LT(depth.at(0, x, y), 100);
    }
    ASSERT_EQ(position.at(2, x, y), miss ? 0 : depth.at(0, x, y));
  });
  EXPECT_GT(sky, 0);
  EXPECT_GT(ids.size(), 10u);
  EXPECT_LT(*ids.rbegin(), std::uint32_t(objects));
}

TEST(Synthetic, SlopeIsTheDerivativeOfDepth) {
  const auto depth = synthetic_image(QUELL_DEPTH, kWidth, kHeight, 0);
  const auto slope = synthetic_image(QUELL_SLOPE, kWidth, kHeight, 0);
  const auto id = synthetic_image(QUELL_ID, kWidth, kHeight, 0);
  int checked = 0;
  for (int y = 0; y + 1 < kHeight; ++y)
    for (int x = 0; x + 1 < kWidth; ++x) {
      const auto here = id.bits(0, y)[x];
      if (here == kNoId || id.bits(0, y)[x + 1] != here || id.bits(0, y + 1)[x] != here) continue;
      ASSERT_NEAR(depth.at(0, x + 1, y) - depth.at(0, x, y), slope.at(0, x, y), 2e-6);
      ASSERT_NEAR(depth.at(0, x, y + 1) - depth.at(0, x, y), slope.at(1, x, y), 2e-6);
      ++checked;
    }
  EXPECT_GT(checked, kWidth * kHeight / 2);
}

TEST(Synthetic, RadianceIsNoisyAndItsMeanIsNot) {
  const auto a = synthetic_image(QUELL_RADIANCE, 640, 360, 0), b = synthetic_image(QUELL_RADIANCE, 640, 360, 1);
  double mean_a = 0, mean_b = 0;
  int black = 0;
  each(a, [&](int x, int y) {
    ASSERT_GE(a.at(1, x, y), 0);
    mean_a += a.at(1, x, y), mean_b += b.at(1, x, y);
    black += a.at(1, x, y) == 0;
  });
  EXPECT_FALSE(same(a, b));
  EXPECT_NEAR(mean_a / mean_b, 1, 0.05);
  EXPECT_GT(black, 640 * 360 / 5);
  EXPECT_LT(black, 640 * 360 / 2);
}

// An input of this name tells emitters from surfaces: noise in it would set most of the picture aside.
TEST(Synthetic, EmissionIsALampThatRadianceHolds) {
  Graph graph;
  graph.inputs = {{"color", QUELL_RADIANCE, false}, {"emission", QUELL_RADIANCE, true}};
  SyntheticSource source(graph, kWidth, kHeight, 1);
  const std::vector<std::string> roles{"color", "emission"};
  const Image color(kWidth, kHeight, 3), emission(kWidth, kHeight, 3);
  source.read(0, roles, std::vector{color.view(), emission.view()});
  int lit = 0;
  each(emission, [&](int x, int y) {
    lit += emission.at(1, x, y) > 0;
    for (int c = 0; c < 3; ++c) ASSERT_LE(emission.at(c, x, y), color.at(c, x, y));
  });
  EXPECT_GT(lit, 0);
  EXPECT_LT(lit, kWidth * kHeight / 20);
}

TEST(Synthetic, MomentsCountsAndTapsAreWhatNodesGive) {
  const auto moments = synthetic_image(QUELL_MOMENTS, kWidth, kHeight, 1);
  const auto count = synthetic_image(QUELL_COUNT, kWidth, kHeight, 1);
  const auto motion = synthetic_image(QUELL_MOTION, kWidth, kHeight, 1);
  const auto taps = synthetic_image(QUELL_TAPS, kWidth, kHeight, 1);
  int whole = 0;
  each(taps, [&](int x, int y) {
    ASSERT_GE(moments.at(1, x, y), moments.at(0, x, y) * moments.at(0, x, y));
    ASSERT_GE(count.at(0, x, y), 1);
    ASSERT_EQ(count.at(0, x, y), std::floor(count.at(0, x, y)));
    for (int c = 0; c < 2; ++c) ASSERT_LT(std::abs(motion.at(c, x, y)), 5);
    float sum = 0;
    for (int i = 0; i < 4; ++i) {
      ASSERT_GE(taps.at(i, x, y), 0);
      sum += taps.at(i, x, y);
    }
    ASSERT_TRUE(sum == 0 || std::abs(sum - 1) < 1e-5f);
    const auto mask = taps.bits(4, y)[x];
    ASSERT_EQ(mask >> 10, 0u);
    whole += int(mask >> 9);
    if (mask >> 9) {
      ASSERT_EQ(mask & 0x1FFu, 0x1FFu);
    }
  });
  EXPECT_GT(whole, kWidth * kHeight * 3 / 4);
}

TEST(Synthetic, CameraSeesPositionsWhereTheyAre) {
  const auto camera = synthetic_image(QUELL_CAMERA, kWidth, kHeight, 0);
  const auto position = synthetic_image(QUELL_POSITION, kWidth, kHeight, 0);
  each(position, [&](int x, int y) {
    if (position.at(2, x, y) == 0) return;
    double screen[4] = {};
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 3; ++c) screen[r] += camera.at(0, 4 * r + c, 1) * position.at(c, x, y);
      screen[r] += camera.at(0, 4 * r + 3, 1);
    }
    ASSERT_NEAR(screen[0] / screen[3], x + 0.5, 1e-3);
    ASSERT_NEAR(screen[1] / screen[3], y + 0.5, 1e-3);
  });
}

TEST(Synthetic, TakesAlternateWhereThereIsNoise) {
  Graph graph;
  graph.inputs = {{"color", QUELL_RADIANCE, false}, {"depth", QUELL_DEPTH, true}};
  SyntheticSource source(graph, kWidth, kHeight, 3);
  const std::vector<std::string> roles{"color", "depth"};
  const auto shapes = source.shapes(0, roles);
  std::vector<std::vector<Image>> frames;
  for (const auto frame : source.frames()) {
    auto& images = frames.emplace_back();
    for (const auto& s : shapes) images.emplace_back(s);
    source.read(frame, roles, std::vector{images[0].view(), images[1].view()});
  }
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_FALSE(same(frames[0][0], frames[1][0]));
  EXPECT_TRUE(same(frames[0][0], frames[2][0]));
  EXPECT_TRUE(same(frames[0][1], frames[1][1]));
  EXPECT_FALSE(source.cut_before(1));
}

}  // namespace
}  // namespace quell
