// The path tracer's buffers: the same bits for any tile, and conventions that projection proves.
#include "plugins/path_tracer/test_scenes.h"

#include <quell/types.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include <tbb/global_control.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace {

using namespace path_tracer_test;

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

// What is seen directly, the light off matte bases and that off gloss make up the whole, up to rounding.
TEST(PathTracer, PartsAddUpToColor) {
  const auto out = tracer(kRoom, 96, 54, 8).run();
  int matte = 0, gloss = 0, both = 0;
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double all = out[kColor].at(c, x, y), diffuse = out[kDiffuse].at(c, x, y),
                     specular = out[kSpecular].at(c, x, y);
        EXPECT_NEAR(out[kEmission].at(c, x, y) + diffuse + specular, all, 2e-6 * all + 1e-6) << x << ',' << y;
        EXPECT_GE(std::min(diffuse, specular), 0);
      }
      const bool d = out[kDiffuse].at(1, x, y) > 0, s = out[kSpecular].at(1, x, y) > 0;
      matte += d && !s, gloss += s && !d, both += d && s;
    }
  EXPECT_GT(matte, 500) << "walls";
  EXPECT_GT(gloss, 50) << "metal and mirror";
  EXPECT_GT(both, 100) << "the polished floor";
}

TEST(PathTracer, LeavesThreadsToTheHost) {
  using tbb::global_control;
  const auto allowed = [] { return global_control::active_value(global_control::max_allowed_parallelism); };
  const auto before = allowed();
  tracer(kRoom, 4, 4).run();
  EXPECT_EQ(allowed(), before);
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

TEST(PathTracer, MotionFromBehindTheCameraIsFarAndFinite) {
  const auto out = tracer(scene_file("behind", R"({ "quell_scene": 1,
      "camera": { "ease": "linear", "target": [0, 0, -10], "fov": 40, "keys": [{ "at": 0, "position": [0, 0, -2] }, { "at": 1, "position": [0, 0, 4] }] },
      "materials": { "m": { "type": "diffuse", "color": [0.5, 0.5, 0.5] } },
      "objects": [{ "name": "ball", "shapes": [{ "type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 0.5 }] }] })"),
                          9, 9)
                       .frame(1)
                       .run();
  ASSERT_EQ(out[kId].bits(0, 4)[4], 0u);
  EXPECT_EQ(out[kMotion].at(0, 4, 4), 1e6f);
  EXPECT_EQ(out[kMotion].at(1, 4, 4), 1e6f);
  EXPECT_EQ(out[kMotion].at(0, 0, 0), 0);  // the sky does not move with a camera that does not turn
}

TEST(PathTracer, LoopsSmoothly) {
  const auto first = tracer(kRoom, 48, 27).frame(0).run(), again = tracer(kRoom, 48, 27).frame(32).run();
  for (const Output o : {kAlbedo, kNormal, kDepth, kPosition, kMotion, kId, kCamera, kTransforms})
    EXPECT_TRUE(same_bits(first[o], again[o])) << o;
}

}  // namespace
