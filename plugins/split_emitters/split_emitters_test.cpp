// Emitters and misses come out whole beside the image, and as misses in the guides.
#include <gtest/gtest.h>
#include <quell/types.h>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::kFar;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;

// 4x1: a surface, a lamp whose albedo is its radiance, a bright surface of albedo above 1, a miss.
struct Scene {
  Image color = noise_image(4, 1, 3, 7, 0.5f, 2.0f);
  Image albedo = constant_image(4, 1, 3, 0.5f);
  Image normal = constant_image(4, 1, 3, 0.0f);
  Image depth = constant_image(4, 1, 1, 3.0f);

  Scene() {
    for (int c = 0; c < 3; ++c) {
      color.at(c, 1, 0) = albedo.at(c, 1, 0) = 14.0f - float(c);
      albedo.at(c, 2, 0) = 1.2f;
      albedo.at(c, 3, 0) = 0;
    }
    for (int x = 0; x < 3; ++x) normal.at(2, x, 0) = 1;
    depth.at(0, 3, 0) = kFar;
  }
};

enum Output { kImage, kEmission, kNormal, kDepth };

TEST(SplitEmitters, SetsAsideALampKnownByItsAlbedoAndMisses) {
  for_each_target([&] {
    Scene s;
    const auto out = Node("split_emitters")
                         .in("image", s.color)
                         .in("albedo", s.albedo)
                         .in("normal", s.normal)
                         .in("depth", s.depth)
                         .run();
    for (int x = 0; x < 4; ++x) {
      const bool apart = x == 1 || x == 3;
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(out[kImage].at(c, x, 0), apart ? 0.0f : s.color.at(c, x, 0)) << x;
        EXPECT_EQ(out[kEmission].at(c, x, 0), apart ? s.color.at(c, x, 0) : 0.0f) << x;
        EXPECT_EQ(out[kNormal].at(c, x, 0), apart ? 0.0f : s.normal.at(c, x, 0)) << x;
      }
      EXPECT_EQ(out[kDepth].at(0, x, 0), apart ? kFar : 3.0f) << x;
    }
  });
}

TEST(SplitEmitters, AGivenEmissionDecidesAlone) {
  for_each_target([&] {
    Scene s;
    auto emission = constant_image(4, 1, 3, 0.0f);
    emission.at(1, 0, 0) = 0.01f;
    const auto out = Node("split_emitters")
                         .in("image", s.color)
                         .in("albedo", s.albedo)
                         .in("emission", emission)
                         .in("depth", s.depth)
                         .run();
    EXPECT_EQ(out[kEmission].at(0, 0, 0), s.color.at(0, 0, 0));
    EXPECT_EQ(out[kEmission].at(0, 1, 0), 0) << "albedo must not be asked";
    EXPECT_EQ(out[kEmission].at(0, 3, 0), s.color.at(0, 3, 0)) << "the depth alone tells a miss";
    EXPECT_TRUE(out[kNormal].empty());
  });
}

TEST(SplitEmitters, KeepSubtractsAGivenEmissionAndLosesNothingBelowZero) {
  for_each_target([&] {
    const auto color = noise_image(17, 3, 3, 1), emission = noise_image(17, 3, 3, 2);
    const auto out = Node("split_emitters").set("mode", "keep").in("image", color).in("emission", emission).run();
    int negative = 0;
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 17; ++x) {
          const double v = color.at(c, x, y), e = emission.at(c, x, y);
          negative += v < e;
          EXPECT_NEAR(out[kImage].at(c, x, y), std::max(v - e, 0.0), 1e-7);
          EXPECT_NEAR(double(out[kImage].at(c, x, y)) + out[kEmission].at(c, x, y), v, 1e-7 * v);
        }
    EXPECT_GT(negative, 10);
  });
}

TEST(SplitEmitters, KeepWithoutEmissionChangesNothing) {
  for_each_target([&] {
    Scene s;
    const auto out = Node("split_emitters")
                         .set("mode", "keep")
                         .in("image", s.color)
                         .in("albedo", s.albedo)
                         .in("normal", s.normal)
                         .in("depth", s.depth)
                         .run();
    for (int x = 0; x < 4; ++x) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(out[kImage].at(c, x, 0), s.color.at(c, x, 0));
        EXPECT_EQ(out[kEmission].at(c, x, 0), 0);
        EXPECT_EQ(out[kNormal].at(c, x, 0), s.normal.at(c, x, 0));
      }
      EXPECT_EQ(out[kDepth].at(0, x, 0), s.depth.at(0, x, 0));
    }
  });
}

}  // namespace
