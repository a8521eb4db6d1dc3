// The path tracer's followed features: exact behind mirrors, noisy behind rough metal, and nothing new elsewhere.
#include "plugins/path_tracer/test_scenes.h"

#include <cmath>

namespace {

using namespace path_tracer_test;

const std::string kHall = QUELL_TEST_SOURCE "/graphs/scenes/hall.json";

Node followed(const std::string& scene, int width, int height, int spp = 1) {
  Node node = tracer(scene, width, height, spp);
  node.set("features", std::string("followed"));
  return node;
}

// A plate of the given material fills the image, tilted by 45° so that it shows a green wall to the right.
std::string plate(const std::string& name, const std::string& material) {
  return scene_file(name, std::string(kHead) + R"(
      "environment": { "horizon": [1, 1, 1] },
      "materials": { "plate": { "type": )" +
                              material + R"(, "color": [0.9, 0.8, 0.5] },
                     "wall": { "type": "diffuse", "color": [0.1, 0.6, 0.2] } },
      "objects": [
        { "name": "plate", "shapes": [{ "type": "quad", "material": "plate", "corner": [-9, -9, -9], "u": [18, 0, 18], "v": [0, 18, 0] }] },
        { "name": "wall", "shapes": [{ "type": "quad", "material": "wall", "corner": [-30, -40, -40], "u": [0, 0, 80], "v": [0, 80, 0] }] }] })");
}

TEST(PathTracerFeatures, BehindAMirrorAreThoseOfWhatItShows) {
  const auto out = followed(plate("mirror", R"("mirror")"), 9, 7).run();
  const auto first = tracer(plate("mirror", R"("mirror")"), 9, 7).run();
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x) {
      ASSERT_EQ(out[kId].bits(0, y)[x], 0u) << "the plate is what is hit first";
      const glm::dvec3 base = rgb(out[kAlbedo], x, y), tinted = glm::dvec3(0.9 * 0.1, 0.8 * 0.6, 0.5 * 0.2);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(base[c], tinted[c], 1e-6);
      EXPECT_NEAR(std::abs(rgb(out[kNormal], x, y).x), 1, 1e-6) << "the wall's";
      EXPECT_NEAR(rgb(first[kAlbedo], x, y).x, 0.9, 1e-6);
      EXPECT_NEAR(std::abs(rgb(first[kNormal], x, y).x), std::sqrt(0.5), 1e-6);
    }
}

TEST(PathTracerFeatures, RoughMetalIsALimit) {
  // GGX alpha 0.0729 shows what is behind it, 0.0784 does not.
  const auto narrow = followed(plate("narrow", R"("conductor", "roughness": 0.27)"), 9, 7).run("albedo");
  const auto wide = followed(plate("wide", R"("conductor", "roughness": 0.28)"), 9, 7).run("albedo");
  int shown = 0;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x) {
      EXPECT_NEAR(wide.at(0, x, y), 0.9, 1e-6);
      // The wall under the metal's tint, or the tint alone where the light is scattered past the wall.
      if (narrow.at(0, x, y) < 0.5f) {
        EXPECT_NEAR(narrow.at(0, x, y), 0.9 * 0.1, 1e-6);
        ++shown;
      } else {
        EXPECT_NEAR(narrow.at(0, x, y), 0.9, 1e-6);
      }
    }
  EXPECT_GT(shown, 50);
}

TEST(PathTracerFeatures, AreNoiseBehindRoughMetalAlone) {
  const int w = 96, h = 54;
  const auto first = tracer(kHall, w, h).run(), one = followed(kHall, w, h).run(),
             other = followed(kHall, w, h).set("seed", 1).run(), many = followed(kHall, w, h, 64).run();
  for (const Output o : {kColor, kDepth, kPosition, kMotion, kId, kEmission, kDiffuse, kSpecular})
    EXPECT_TRUE(same_bits(first[o], one[o])) << o;
  int noisy = 0, plain = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const glm::dvec3 base = rgb(one[kAlbedo], x, y);
      const bool differs = base != rgb(other[kAlbedo], x, y);
      noisy += differs;
      plain += !differs && base == rgb(first[kAlbedo], x, y);
      if (rgb(one[kEmission], x, y) != glm::dvec3(0)) {
        EXPECT_EQ(base, glm::dvec3(0));
      }
      EXPECT_NEAR(glm::length(rgb(many[kNormal], x, y)), 1, 1e-6) << "a mean of directions is one";
    }
  EXPECT_GT(noisy, w * h / 50) << "columns and balls";
  EXPECT_GT(plain, w * h / 2) << "walls and floor";
}

TEST(PathTracerFeatures, SameBitsForAnyTile) {
  const auto whole = followed(kHall, 41, 23, 3).frame(5).run();
  expect_same(whole, followed(kHall, 41, 23, 3).frame(5).tiles(7, 5).run());
}

}  // namespace
