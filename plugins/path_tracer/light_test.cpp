// The path tracer's light against what is known without tracing paths: furnaces, form factors and its own statistics.
#include "plugins/path_tracer/test_scenes.h"
#include "tests/support/paths.h"

#include <cmath>

namespace {

using namespace path_tracer_test;

TEST(PathTracer, WhiteFurnaceIsInvisible) {
  // In an even environment of 1, surfaces that absorb nothing cannot be seen, whatever light bounces between them.
  const std::string scene = scene_file("furnace", std::string(kHead) + R"(
      "environment": { "horizon": [1, 1, 1] },
      "portals": [{ "corner": [-1, 2, -1], "u": [2, 0, 0], "v": [0, 0, 2] }],
      "materials": { "white": { "type": "diffuse", "color": [1, 1, 1] }, "mirror": { "type": "mirror" },
                     "glass": { "type": "glass", "ior": 1.5 } },
      "objects": [
        { "name": "things", "shapes": [
          { "type": "box", "material": "white", "min": [-1.5, -1, -1], "max": [1.5, -0.6, 1] },
          { "type": "frustum", "material": "white", "from": [-0.9, -0.6, 0], "to": [-0.9, 0.5, 0], "radius": [0.3, 0.1] },
          { "type": "sphere", "material": "mirror", "center": [0.1, 0, 0], "radius": 0.4 },
          { "type": "sphere", "material": "glass", "center": [1, 0, 0.3], "radius": 0.35 }] },
        { "name": "spinning", "keys": [{ "at": 0, "rotate": [0, 0, 0] }, { "at": 8, "rotate": [40, 90, 0], "translate": [0, 0.3, 0] }],
          "shapes": [{ "type": "box", "material": "white", "min": [-0.3, 0.5, -0.3], "max": [0.3, 0.9, 0.3] }] }] })");
  // The estimate of a path that ends anywhere but in the environment loses light; 1000 bounces leave none of those.
  const Image color = tracer(scene, 32, 24, 256).set("max_bounces", 1000).frame(3).run("color");
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) EXPECT_NEAR(color.at(1, x, y), 1, 0.05) << x << ' ' << y;
  EXPECT_NEAR(mean(color), 1, 2e-3);
}

TEST(PathTracer, DiffuseBallReflectsItsAlbedo) {
  const std::string scene = scene_file("ball", std::string(kHead) + R"(
      "environment": { "horizon": [2, 2, 2] },
      "materials": { "grey": { "type": "diffuse", "color": [0.25, 0.5, 0.75] } },
      "objects": [{ "name": "ball", "shapes": [{ "type": "sphere", "material": "grey", "center": [0, 0, 0], "radius": 2.5 }] }] })");
  const Image color = tracer(scene, 8, 8, 4).run("color");
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) EXPECT_NEAR(color.at(c, x, y), 0.5 * (c + 1), 1e-4);
}

// Share of light from all sides that GGX facets without absorption send to a viewer at this cosine after one
// reflection: the integral of D G2 / (4 cosine) (Walter et al. 2007, eq. 20, 33; Heitz 2014, eq. 99) by the midpoint
// rule.
double single_scattering(double cosine, double alpha) {
  const int n = 400;
  const glm::dvec3 from(std::sqrt(1 - cosine * cosine), 0, cosine);
  const auto lambda = [&](double z) { return 0.5 * (std::sqrt(1 + alpha * alpha * (1 - z * z) / (z * z)) - 1); };
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double z = (i + 0.5) / n, phi = 2 * M_PI * (j + 0.5) / n, r = std::sqrt(1 - z * z);
      const glm::dvec3 h = glm::normalize(from + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
      const double spread = h.x * h.x + h.y * h.y + alpha * alpha * h.z * h.z;
      sum += alpha * alpha / (M_PI * spread * spread) / (1 + lambda(z) + lambda(cosine)) / (4 * cosine);
    }
  return sum * 2 * M_PI / (n * n);
}

std::string ball_in_white(const std::string& type, double roughness) {
  return scene_file("gloss", std::string(kHead) + R"(
      "environment": { "horizon": [1, 1, 1] },
      "materials": { "m": { "type": ")" +
                                 type + R"(", "roughness": )" + std::to_string(roughness) + R"(, "color": [1, 1, 1] } },
      "objects": [{ "name": "ball", "shapes": [{ "type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1.35 }] }] })");
}

TEST(PathTracer, MetalReflectsWhatGgxSays) {
  for (const double roughness : {0.4, 0.7, 1.0}) {
    const auto out = tracer(ball_in_white("conductor", roughness), 5, 5, 8192).run();
    const glm::dvec3 eye(0, 0, 4);
    int tested = 0;
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x) {
        if (out[kId].bits(0, y)[x] != 0) continue;
        const double cosine = glm::dot(glm::normalize(eye - rgb(out[kPosition], x, y)), rgb(out[kNormal], x, y));
        EXPECT_NEAR(out[kColor].at(0, x, y), single_scattering(cosine, roughness * roughness), 0.01)
            << "roughness " << roughness << ", cosine " << cosine;
        ++tested;
      }
    EXPECT_GT(tested, 20);
  }
}

TEST(PathTracer, GlossReflectsNoMoreThanArrives) {
  for (const char* type : {"conductor", "plastic"})
    for (const double roughness : {0.05, 0.3, 1.0}) {
      const double reflected = mean(tracer(ball_in_white(type, roughness), 12, 12, 512).run("color"));
      EXPECT_LT(reflected, 1 + 2e-3) << type << roughness;
      EXPECT_GT(reflected, 0.3) << type << roughness;
    }
}

// Irradiance from a polygon (Lambert 1760; Arvo 1994, eq. 2.25): half the sum of edge angles times their normals'
// cosines.
double irradiance(const glm::dvec3& p, const glm::dvec3& n, const std::vector<glm::dvec3>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = glm::normalize(polygon[i] - p), b = glm::normalize(polygon[(i + 1) % polygon.size()] - p);
    sum += std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::dot(glm::normalize(glm::cross(a, b)), n);
  }
  return std::abs(0.5 * sum);
}

TEST(PathTracer, QuadLightGivesTheFormFactor) {
  const std::string head = R"({ "quell_scene": 1, "camera": { "position": [0, 3, 0.1], "target": [0, 0, 0], "fov": 50 },
      "materials": { "floor": { "type": "diffuse", "color": [0.8, 0.8, 0.8] }, "lamp": { "type": "emitter", "radiance": [5, 5, 5] } },
      "objects": [{ "name": "floor", "shapes": [{ "type": "quad", "material": "floor", "corner": [-5, 0, 5], "u": [10, 0, 0], "v": [0, 0, -10] }] },)";
  // The same lamp as a quad that shines down, and as two triangles that shine down.
  const std::string quad =
      R"({ "type": "quad", "material": "lamp", "corner": [-2.5, 1.2, -0.5], "u": [1, 0, 0], "v": [0, 0, 1] })";
  const std::string mesh = R"({ "type": "mesh", "material": "lamp",
      "vertices": [[-2.5, 1.2, -0.5], [-1.5, 1.2, -0.5], [-1.5, 1.2, 0.5], [-2.5, 1.2, 0.5]], "triangles": [[0, 1, 2], [0, 2, 3]] })";
  for (const std::string& lamp : {quad, mesh}) {
    const std::string scene = scene_file("form_factor", head + R"({ "name": "lamp", "shapes": [)" + lamp + R"(] }] })");
    const auto out = tracer(scene, 9, 5, 4096).set("max_bounces", 1).run();
    int tested = 0;
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 9; ++x) {
        if (out[kId].bits(0, y)[x] != 0) continue;
        const double e = 5 * irradiance(rgb(out[kPosition], x, y), {0, 1, 0},
                                        {{-2.5, 1.2, -0.5}, {-1.5, 1.2, -0.5}, {-1.5, 1.2, 0.5}, {-2.5, 1.2, 0.5}});
        EXPECT_NEAR(out[kColor].at(0, x, y), 0.8 / M_PI * e, 0.01 * 0.8 / M_PI * e) << x << ' ' << y;
        ++tested;
      }
    EXPECT_GT(tested, 30);
  }
}

TEST(PathTracer, SphereLightGivesTheInverseSquare) {
  // A sphere of radius r, seen whole from below at distance d, gives irradiance π L (r/d)² cosine.
  const std::string scene = scene_file("sphere_light", R"({ "quell_scene": 1,
      "camera": { "position": [0, 3, 0.1], "target": [0, 0, 0], "fov": 50 },
      "materials": { "floor": { "type": "diffuse", "color": [0.8, 0.8, 0.8] }, "lamp": { "type": "emitter", "radiance": [40, 40, 40] } },
      "objects": [
        { "name": "floor", "shapes": [{ "type": "quad", "material": "floor", "corner": [-5, 0, 5], "u": [10, 0, 0], "v": [0, 0, -10] }] },
        { "name": "lamp", "shapes": [{ "type": "sphere", "material": "lamp", "center": [2, 1, 0], "radius": 0.2 }] }] })");
  const auto out = tracer(scene, 9, 5, 1024).set("max_bounces", 1).run();
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 9; ++x) {
      if (out[kId].bits(0, y)[x] != 0) continue;
      const glm::dvec3 to = glm::dvec3(2, 1, 0) - rgb(out[kPosition], x, y);
      const double d = glm::length(to), e = M_PI * 40 * 0.04 / (d * d) * to.y / d;
      EXPECT_NEAR(out[kColor].at(0, x, y), 0.8 / M_PI * e, 0.01 * 0.8 / M_PI * e) << x << ' ' << y;
    }
}

TEST(PathTracer, AimingAtOpeningsChangesNoMean) {
  // Gloss, coat and plaster under a skylight: by scattered directions alone, and with the opening declared.
  const auto scene = [](const std::string& name, const std::string& portals) {
    return scene_file(name,
                      R"({ "quell_scene": 1, "camera": { "position": [0, 1.2, 1.9], "target": [0, 0.6, 0], "fov": 70 },
      "environment": { "horizon": [3, 2, 1], "zenith": [1, 2, 3] },)" +
                          portals + R"(
      "materials": { "wall": { "type": "diffuse", "color": [0.5, 0.5, 0.5] }, "gold": { "type": "conductor", "roughness": 0.4, "color": [0.9, 0.7, 0.4] },
                     "coat": { "type": "plastic", "roughness": 0.4, "color": [0.6, 0.2, 0.2] } },
      "objects": [{ "name": "box", "shapes": [
        { "type": "box", "material": "coat", "min": [-2, -0.1, -2], "max": [2, 0, 2] }, { "type": "box", "material": "wall", "min": [-2.1, 0, -2], "max": [-2, 3, 2] },
        { "type": "box", "material": "wall", "min": [2, 0, -2], "max": [2.1, 3, 2] }, { "type": "box", "material": "wall", "min": [-2, 0, -2.1], "max": [2, 3, -2] },
        { "type": "box", "material": "wall", "min": [-2, 0, 2], "max": [2, 3, 2.1] },
        { "type": "sphere", "material": "gold", "center": [0, 0.6, 0], "radius": 0.6 }] }] })");
  };
  const double plain = mean(tracer(scene("plain", ""), 16, 9, 2048).run("color"));
  const double aimed =
      mean(tracer(scene("aimed", R"("portals": [{ "corner": [-2, 3, -2], "u": [4, 0, 0], "v": [0, 0, 4] },
      { "corner": [-1, 3.5, -1], "u": [2, 0, 0], "v": [0, 0, 2] }],)"),
                  16, 9, 2048)
               .run("color"));
  EXPECT_NEAR(aimed, plain, 0.005 * plain);
}

TEST(PathTracer, OneSampleIsUnbiased) {
  const int seeds = 300;
  const double reference = mean(tracer(kRoom, 24, 14, 2048).set("seed", 77777).frame(4).run("color"));
  double sum = 0, squares = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const double m = mean(tracer(kRoom, 24, 14).set("seed", seed).frame(4).run("color"));
    sum += m, squares += m * m;
  }
  const double average = sum / seeds, deviation = std::sqrt((squares / seeds - average * average) / seeds);
  EXPECT_NEAR(average, reference, 4 * deviation);
  EXPECT_LT(deviation, 0.02 * reference);
}

TEST(PathTracer, SamplesOfAPixelAreStratified) {
  // 16 samples together must do better than 16 that know nothing of each other.
  const Image reference = tracer(kRoom, 24, 14, 1024).set("seed", 99).set("clamp", 4.0f).run("color");
  const auto error = [&](const Image& image) {
    double sum = 0;
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 24; ++x) sum += std::pow(image.at(1, x, y) - reference.at(1, x, y), 2);
    return sum;
  };
  const double together = error(tracer(kRoom, 24, 14, 16).set("clamp", 4.0f).run("color"));
  Image average(24, 14, 3);
  average.fill(0);
  for (int seed = 0; seed < 16; ++seed) {
    const Image one = tracer(kRoom, 24, 14).set("seed", seed).set("clamp", 4.0f).run("color");
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 24; ++x) average.at(1, x, y) += one.at(1, x, y) / 16;
  }
  EXPECT_LT(together, 0.9 * error(average));
}

TEST(PathTracer, ClampLimitsEverySample) {
  const Image free = tracer(kRoom, 64, 36, 4).run("color"),
              held = tracer(kRoom, 64, 36, 4).set("clamp", 1.5f).run("color");
  float most = 0, most_held = 0;
  for (int y = 0; y < 36; ++y)
    for (int x = 0; x < 64; ++x)
      most = std::max(most, free.at(0, x, y)), most_held = std::max(most_held, held.at(0, x, y));
  EXPECT_GT(most, 1.5f);
  EXPECT_LE(most_held, 1.5f);
}

TEST(PathTracer, BoxJitterMovesColourButNoFeature) {
  const auto center = tracer(kRoom, 32, 18).run(), box = tracer(kRoom, 32, 18).set("jitter", std::string("box")).run();
  EXPECT_FALSE(same_bits(center[kColor], box[kColor]));
  for (const Output o : {kAlbedo, kNormal, kDepth, kPosition, kMotion, kId}) EXPECT_TRUE(same_bits(center[o], box[o]));
}

TEST(PathTracer, EmissionIsWhatIsSeenOfLights) {
  // Lamps that shine black before the frame in which they switch on.
  struct Lamp {
    const char* scene;
    int frame;
    glm::dvec3 radiance;
  };
  for (const Lamp& lamp : {Lamp{"arcade", 10, {26, 19.5, 13}}, Lamp{"yard", 12, {300, 220, 130}}}) {
    SCOPED_TRACE(lamp.scene);
    const std::string scene = std::string(QUELL_TEST_SOURCE "/graphs/scenes/") + lamp.scene + ".json";
    const auto off = tracer(scene, 96, 54).frame(lamp.frame - 1).run(),
               on = tracer(scene, 96, 54).frame(lamp.frame).run();
    int switched = 0;
    for (int y = 0; y < 54; ++y)
      for (int x = 0; x < 96; ++x) {
        const glm::dvec3 before = rgb(off[kEmission], x, y), after = rgb(on[kEmission], x, y);
        if (after == lamp.radiance && before == glm::dvec3(0)) ++switched;
        if (after != glm::dvec3(0)) {
          EXPECT_EQ(rgb(on[kColor], x, y), after);
        }
        for (int c = 0; c < 3; ++c) EXPECT_GE(on[kColor].at(c, x, y), on[kEmission].at(c, x, y));
      }
    EXPECT_GT(switched, 4);
  }
}

}  // namespace
