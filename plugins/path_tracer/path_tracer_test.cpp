// The path tracer against what is known without tracing paths: projection, form factors, furnaces and its own
// statistics.
#include "tests/support/run_node.h"

#include <quell/types.h>

#include <gtest/gtest.h>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/glm.hpp>
#include <string>
#include <thread>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace {

using quell::Image;
using quell::test::Node;

const std::string kRoom = QUELL_TEST_SOURCE "/graphs/scenes/room.json";

enum Output { kColor, kAlbedo, kNormal, kDepth, kPosition, kMotion, kId, kEmission, kCamera, kTransforms };

// A scene file that lives as long as the test program's folder for such files.
std::string scene_file(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + "quell_path_tracer_" + name + ".json";
  std::ofstream(file) << text;
  return file;
}

Node tracer(const std::string& scene, int width, int height, int spp = 1) {
  Node node("path_tracer");
  node.set("scene", scene).set("width", width).set("height", height).set("spp", spp);
  return node;
}

glm::dmat4 matrix(const Image& table, int row) {
  glm::dmat4 m;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) m[c][r] = table.at(0, 4 * r + c, row);
  return m;
}

glm::dvec3 rgb(const Image& image, int x, int y) { return {image.at(0, x, y), image.at(1, x, y), image.at(2, x, y)}; }

glm::dvec2 projected(const glm::dmat4& screen, const glm::dvec4& p) {
  const glm::dvec4 q = screen * p;
  return glm::dvec2(q.x, q.y) / q.w;
}

double mean(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += image.at(0, x, y) + image.at(1, x, y) + image.at(2, x, y);
  return sum / (3.0 * image.width() * image.height());
}

bool same_bits(const Image& a, const Image& b) {
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * sizeof(float)) != 0) return false;
  return a.shape().width == b.shape().width && a.shape().height == b.shape().height && a.channels() == b.channels();
}

void expect_same(const std::vector<Image>& a, const std::vector<Image>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(same_bits(a[i], b[i])) << "output " << i;
}

const char* const kHead = R"({ "quell_scene": 1, "camera": { "position": [0, 0, 4], "target": [0, 0, 0], "fov": 40 },)";

// ---- The same bits ----

TEST(PathTracer, SameBitsForAnyTile) {
  const auto whole = tracer(kRoom, 41, 23, 2).frame(5).run();
  expect_same(whole, tracer(kRoom, 41, 23, 2).frame(5).tiles(1).run());
  expect_same(whole, tracer(kRoom, 41, 23, 2).frame(5).tiles(7, 5).run());
}

TEST(PathTracer, SameBitsFromSeveralThreads) {
  const auto alone = tracer(kRoom, 32, 18).frame(9).run();
  std::vector<std::vector<Image>> results(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < results.size(); ++i)
    threads.emplace_back([&results, i] { results[i] = tracer(kRoom, 32, 18).frame(9).tiles(int(i) + 2).run(); });
  for (auto& t : threads) t.join();
  for (const auto& r : results) expect_same(alone, r);
}

#if defined(__SSE2__)
TEST(PathTracer, SameBitsWhereDenormalsAreFlushed) {
  const auto plain = tracer(kRoom, 32, 18, 2).run();
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040);  // flush to zero, denormals are zero: as in the host's workers
  const auto flushed = tracer(kRoom, 32, 18, 2).run();
  _mm_setcsr(before);
  expect_same(plain, flushed);
}
#endif

TEST(PathTracer, SeedAndFrameChooseTheNoise) {
  const Image a = tracer(kRoom, 32, 18).run("color"), b = tracer(kRoom, 32, 18).set("seed", 1).run("color");
  EXPECT_FALSE(same_bits(a, b));
  // The animation loops after 32 frames, so these show the same scene.
  EXPECT_FALSE(same_bits(a, tracer(kRoom, 32, 18).frame(32).run("color")));
}

TEST(PathTracer, OnePixelAndOddSizes) {
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 9}, {9, 1}, {17, 3}}) {
    const auto all = tracer(kRoom, w, h).run();
    for (const Image& image : all)
      for (int c = 0; c < image.channels(); ++c)
        for (int y = 0; y < image.height(); ++y)
          for (int x = 0; x < image.width(); ++x)
            if (&image != &all[kId]) {
              ASSERT_TRUE(std::isfinite(image.at(c, x, y)));
            }
  }
}

// ---- Conventions ----

TEST(PathTracer, FeaturesAgreeWithTheCamera) {
  const int w = 96, h = 54;
  for (const std::int64_t frame : {0, 13, 77}) {
    const auto out = tracer(kRoom, w, h).frame(frame).run();
    const glm::dmat4 view = matrix(out[kCamera], 0), screen = matrix(out[kCamera], 1);
    int misses = 0;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        if (out[kId].bits(0, y)[x] == quell::kNoId) {
          ++misses;
          EXPECT_EQ(out[kDepth].at(0, x, y), quell::kFar);
          EXPECT_EQ(rgb(out[kNormal], x, y), glm::dvec3(0));
          EXPECT_EQ(rgb(out[kPosition], x, y), glm::dvec3(0));
          EXPECT_EQ(rgb(out[kAlbedo], x, y), glm::dvec3(0));
          EXPECT_EQ(rgb(out[kEmission], x, y), rgb(out[kColor], x, y));
          continue;
        }
        const glm::dvec4 p(rgb(out[kPosition], x, y), 1);
        const glm::dvec2 at = projected(screen, p);
        EXPECT_NEAR(at.x, x + 0.5, 1e-3);
        EXPECT_NEAR(at.y, y + 0.5, 1e-3);
        const double depth = (view * p).z;
        EXPECT_NEAR(depth, out[kDepth].at(0, x, y), 1e-5 * depth);
        const glm::dvec3 n = rgb(out[kNormal], x, y);
        EXPECT_NEAR(glm::length(n), 1, 1e-6);
        const glm::dvec3 eye(glm::inverse(view)[3]);
        EXPECT_GT(glm::dot(n, eye - glm::dvec3(p)), 0);
        EXPECT_LT(out[kId].bits(0, y)[x], std::uint32_t(out[kTransforms].height()));
        if (glm::length(rgb(out[kEmission], x, y)) > 0) {
          EXPECT_EQ(rgb(out[kAlbedo], x, y), glm::dvec3(0));
        }
      }
    EXPECT_GT(misses, 50);
    EXPECT_LT(misses, w * h / 4);
  }
}

TEST(PathTracer, ViewMatrixIsRigidWithAxesRightUpForward) {
  const auto out = tracer(scene_file("axes", std::string(kHead) + R"(
      "materials": { "m": { "type": "diffuse", "color": [0.5, 0.5, 0.5] } },
      "objects": [{ "name": "ball", "shapes": [{ "type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 0.1 }] }] })"),
                          8, 8)
                       .run();
  const glm::dmat4 view = matrix(out[kCamera], 0);
  // The camera stands at z = 4 and looks along -z.
  EXPECT_NEAR(glm::length(view * glm::dvec4(1, 0, 4, 1) - glm::dvec4(1, 0, 0, 1)), 0, 1e-6);
  EXPECT_NEAR(glm::length(view * glm::dvec4(0, 1, 4, 1) - glm::dvec4(0, 1, 0, 1)), 0, 1e-6);
  EXPECT_NEAR(glm::length(view * glm::dvec4(0, 0, 1, 1) - glm::dvec4(0, 0, 3, 1)), 0, 1e-6);
  const glm::dvec2 high = projected(matrix(out[kCamera], 1), {0, 1, 0, 1});
  EXPECT_NEAR(high.x, 4, 1e-4);
  EXPECT_LT(high.y, 4);
}

TEST(PathTracer, MotionFollowsCameraAndObjects) {
  const int w = 96, h = 54;
  // Frame -1 is defined too: the animation has no beginning.
  for (const std::int64_t frame : {0, 1, 20}) {
    const auto now = tracer(kRoom, w, h).frame(frame).run(), then = tracer(kRoom, w, h).frame(frame - 1).run();
    const glm::dmat4 screen = matrix(then[kCamera], 1);
    double largest = 0, moved_by_object = 0;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const glm::dvec2 motion(now[kMotion].at(0, x, y), now[kMotion].at(1, x, y));
        const std::uint32_t id = now[kId].bits(0, y)[x];
        glm::dvec2 expected;
        if (id == quell::kNoId) {
          // A direction: where both matrices agree up to translation, that of a point very far away.
          const glm::dmat4 view = matrix(now[kCamera], 0);
          const glm::dmat4 lens = matrix(now[kCamera], 1) * glm::inverse(view);
          const glm::dvec3 seen((x + 0.5 - lens[2][0]) / lens[0][0], (y + 0.5 - lens[2][1]) / lens[1][1], 1);
          expected = projected(screen, glm::dvec4(glm::transpose(glm::dmat3(view)) * seen, 0));
        } else {
          const glm::dvec4 p(rgb(now[kPosition], x, y), 1);
          const glm::dmat4 back = matrix(then[kTransforms], int(id)) * glm::inverse(matrix(now[kTransforms], int(id)));
          expected = projected(screen, back * p);
          moved_by_object = std::max(moved_by_object, glm::length(expected - projected(screen, p)));
        }
        EXPECT_NEAR(motion.x, expected.x - (x + 0.5), 2e-3) << x << ' ' << y;
        EXPECT_NEAR(motion.y, expected.y - (y + 0.5), 2e-3) << x << ' ' << y;
        largest = std::max(largest, glm::length(motion));
      }
    EXPECT_GT(largest, 0.5);
    EXPECT_GT(moved_by_object, 0.5);
    EXPECT_LT(largest, 8);
  }
}

TEST(PathTracer, LoopsSmoothly) {
  const auto first = tracer(kRoom, 48, 27).frame(0).run(), again = tracer(kRoom, 48, 27).frame(32).run();
  for (const Output o : {kAlbedo, kNormal, kDepth, kPosition, kMotion, kId, kCamera, kTransforms})
    EXPECT_TRUE(same_bits(first[o], again[o])) << o;
}

// ---- Light ----

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
  // The arcade's middle lamp switches on at frame 10 and shines black before.
  const std::string arcade = QUELL_TEST_SOURCE "/graphs/scenes/arcade.json";
  const auto off = tracer(arcade, 96, 54).frame(9).run(), on = tracer(arcade, 96, 54).frame(10).run();
  int switched = 0;
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) {
      const glm::dvec3 before = rgb(off[kEmission], x, y), after = rgb(on[kEmission], x, y);
      if (after == glm::dvec3(26, 19.5, 13) && before == glm::dvec3(0)) ++switched;
      if (after != glm::dvec3(0)) {
        EXPECT_EQ(rgb(on[kColor], x, y), after);
      }
      for (int c = 0; c < 3; ++c) EXPECT_GE(on[kColor].at(c, x, y), on[kEmission].at(c, x, y));
    }
  EXPECT_GT(switched, 4);
}

// ---- Bad scene files ----

std::string complaint(const std::string& text) {
  const std::string file = scene_file("bad", text);
  try {
    tracer(file, 4, 4).run();
  } catch (const std::exception& e) {
    std::string what = e.what();
    for (auto at = what.find(file); at != std::string::npos; at = what.find(file)) what.replace(at, file.size(), "S");
    return what;
  }
  return "no error";
}

// A scene with one material and one shape, given as text.
std::string with(const std::string& material, const std::string& shape) {
  return std::string(kHead) + R"("materials": { "m": )" + material + R"( }, "objects": [{ "name": "o", "shapes": [)" +
         shape + "] }] }";
}

const char* const kGrey = R"({ "type": "diffuse", "color": [0.5, 0.5, 0.5] })";
const char* const kBall = R"({ "type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1 })";

TEST(PathTracerErrors, NameTheOffenderItsValueAndTheWayOut) {
  EXPECT_EQ(complaint(with(kGrey, kBall)), "no error");
  EXPECT_EQ(complaint(with(R"({ "type": "velvet" })", kBall)),
            "S: materials.m.type: \"velvet\" is not one of: diffuse, plastic, conductor, mirror, glass, emitter");
  EXPECT_EQ(complaint(with(R"({ "type": "conductor", "color": [1, 1, 1], "roughness": 3 })", kBall)),
            "S: materials.m.roughness: 3 is out of range; it must be from 0.03 to 1");
  EXPECT_EQ(
      complaint(with(R"({ "type": "diffuse", "colour": [1, 1, 1] })", kBall)),
      "S: materials.m.colour: unknown key; known here: type, color, roughness, ior, radiance, strength, two_sided\n"
      "S: materials.m.color: missing");
  EXPECT_EQ(complaint(with(R"({ "type": "diffuse", "color": [1, 1.5, 1] })", kBall)),
            "S: materials.m.color[1]: 1.5 is out of range; it must be from 0 to 1");
  EXPECT_EQ(complaint(with(kGrey, R"({ "type": "sphere", "material": "gold", "center": [0, 0, 0], "radius": 1 })")),
            "S: objects[0].shapes[0].material: no material is called 'gold'; there are: m");
  EXPECT_EQ(complaint(with(kGrey, R"({ "type": "sphere", "material": "m", "center": [0, 0], "radius": "big" })")),
            "S: objects[0].shapes[0].center: [0,0] is not an array of 3 numbers\n"
            "S: objects[0].shapes[0].radius: \"big\" is not a number");
  EXPECT_EQ(complaint(with(
                kGrey, R"({ "type": "quad", "material": "m", "corner": [0, 0, 0], "u": [1, 0, 0], "v": [2, 0, 0] })")),
            "S: objects[0].shapes[0].v: 'u' and 'v' must span an area");
  EXPECT_EQ(
      complaint(with(R"({ "type": "emitter", "radiance": [1, 1, 1] })",
                     R"({ "type": "frustum", "material": "m", "from": [0, 0, 0], "to": [0, 1, 0], "radius": 1 })")),
      "S: objects[0].shapes[0].material: a frustum cannot emit; emitters are quads, boxes, spheres, disks and meshes");
}

TEST(PathTracerErrors, Files) {
  EXPECT_EQ(complaint("{ \"quell_scene\": 2 }").substr(0, 53), "S: quell_scene: must be 1, the version of this format");
  EXPECT_EQ(complaint(std::string(kHead) + R"("about": "a", "about": "b" })"),
            "S: key 'about' stands twice in one object; remove one");
  EXPECT_EQ(complaint("{\n  \"quell_scene\": 1,,\n}").substr(0, 23), "S:2:20: not valid JSON:");
  try {
    tracer("/no/such/scene.json", 4, 4).run();
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(), "/no/such/scene.json: cannot open the scene file; set 'scene' to one that exists");
  }
}

TEST(PathTracerErrors, Keys) {
  const auto animated = [](const std::string& keys) {
    return std::string(kHead) + R"("loop": 8, "materials": { "m": { "type": "diffuse", "color": [0.5, 0.5, 0.5] } },
      "objects": [{ "name": "o", "keys": )" +
           keys + R"(, "shapes": [{ "type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1 }] }] })";
  };
  EXPECT_EQ(complaint(animated(R"([{ "at": 0 }, { "at": 8, "translate": [1, 0, 0] }])")), "no error");
  EXPECT_EQ(complaint(animated(R"([{ "at": 0 }, { "at": 5 }])")),
            "S: objects[0].keys: in a looping scene the keys must begin at 0 and end at 8, the scene's 'loop'");
  EXPECT_EQ(complaint(animated(R"([{ "at": 0 }, { "at": 6 }, { "at": 6 }, { "at": 8 }])")),
            "S: objects[0].keys[2].at: keys must be in order of time, and no two at one time");
  EXPECT_EQ(complaint(animated(R"([{ "translate": [1, 0, 0] }])")), "S: objects[0].keys[0].at: missing");
}

}  // namespace
