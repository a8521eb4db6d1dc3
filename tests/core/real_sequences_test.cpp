// Real renders through the sequence files of tests/data_sequences, where QUELL_TEST_DATA points at them: do the
// conventions hold, as projecting each pixel's own position can tell?
#include "core/image/image.h"
#include "core/sequence/matrices.h"
#include "core/sequence/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/read_role.h"

#include <quell/types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace quell::test {
namespace {

class RealSequence : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::getenv("QUELL_TEST_DATA")) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  }

  static std::unique_ptr<FileSequence> open(const std::string& name, const std::string& folder) {
    const std::filesystem::path source = QUELL_TEST_SOURCE;
    SequenceRequest request;
    request.path = (source / "tests/data_sequences" / (name + ".json")).string();
    request.root = (std::filesystem::path(std::getenv("QUELL_TEST_DATA")) / folder).string();
    request.profiles = source / "graphs/profiles";
    Diagnostics diagnostics;
    const auto sequence = load_sequence(request, diagnostics);
    auto opened = sequence ? open_sequence(*sequence, {}, Missing::error, diagnostics) : nullptr;
    EXPECT_TRUE(opened) << diagnostics.format();
    return opened;
  }
  static Matrix matrix(const Image& table, int row) {
    Matrix m;
    for (int i = 0; i < 16; ++i) m[std::size_t(i)] = double(table.at(0, i, row));
    return m;
  }
  struct Point {
    double v[4];
  };
  static Point apply(const Matrix& m, const Point& p) {
    Point out{};
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c) out.v[r] += m[4 * r + c] * p.v[c];
    return out;
  }

  // Largest distance, in pixels, between where a pixel's position projects to and its centre; and largest difference
  // between its depth and that of its position.
  struct Agreement {
    double pixels = 0, depth = 0;
    int hits = 0;
  };
  static Agreement agreement(FrameSource& source, std::int64_t frame) {
    const Image position = read_role(source, frame, "position"), depth = read_role(source, frame, "depth"),
                camera = read_role(source, frame, "camera");
    const Matrix view = matrix(camera, 0), screen = matrix(camera, 1);
    Agreement out;
    for (int y = 0; y < depth.height(); ++y)
      for (int x = 0; x < depth.width(); ++x) {
        if (depth.at(0, x, y) == kFar) continue;
        ++out.hits;
        const Point p = {{position.at(0, x, y), position.at(1, x, y), position.at(2, x, y), 1}};
        const Point s = apply(screen, p);
        out.pixels = std::max(out.pixels, std::hypot(s.v[0] / s.v[3] - x - 0.5, s.v[1] / s.v[3] - y - 0.5));
        out.depth = std::max(out.depth, std::abs(apply(view, p).v[2] / double(depth.at(0, x, y)) - 1));
      }
    return out;
  }
};

TEST_F(RealSequence, Games202KeepsItsConventions) {
  const auto source = open("games202-box", "games202-box");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->frames().size(), 10u);
  const auto found = agreement(*source, 3);
  EXPECT_LT(found.pixels, 1e-3);
  EXPECT_LT(found.depth, 1e-5);
  EXPECT_EQ(found.hits, 512 * 512 - 14140);
  const Image id = read_role(*source, 3, "id"), normal = read_role(*source, 3, "normal"),
              position = read_role(*source, 3, "position"), depth = read_role(*source, 3, "depth");
  int misses = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      const bool miss = id.bits(0, y)[x] == kNoId;
      misses += miss;
      const double length =
          std::hypot(double(normal.at(0, x, y)), double(normal.at(1, x, y)), double(normal.at(2, x, y)));
      ASSERT_NEAR(length, miss ? 0.0 : 1.0, 1e-6);
      ASSERT_EQ(depth.at(0, x, y) == kFar, miss);
      ASSERT_TRUE(!miss || position.at(0, x, y) == 0.0f);
    }
  EXPECT_EQ(misses, 14140);
  EXPECT_EQ(read_role(*source, 3, "transforms").height(), 7);
}

TEST_F(RealSequence, CyclesCornellReads) {
  const auto source = open("cycles-cornell", "cycles-cornell");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->frames().size(), 16u);
  EXPECT_EQ(source->reference_frames(), (std::vector<std::int64_t>{4, 8, 15, 16}));
  EXPECT_EQ(source->roles().at("motion"), QUELL_MOTION);
  EXPECT_EQ(read_role(*source, 8, "reference_a").width(), 480);
  EXPECT_EQ(read_role(*source, 8, "transforms").height(), 10);
  // The static floor: a point goes where motion says. Previous = current + motion.
  const Image now = read_role(*source, 8, "camera"), before = read_role(*source, 7, "camera"),
              depth = read_role(*source, 8, "depth"), motion = read_role(*source, 8, "motion"),
              id = read_role(*source, 8, "id");
  Matrix screen_to_world;
  ASSERT_TRUE(invert(matrix(now, 1), screen_to_world));
  double worst = 0;
  int floor = 0;
  for (int y = 0; y < 270; ++y)
    for (int x = 0; x < 480; ++x) {
      if (id.bits(0, y)[x] != 1) continue;
      // A point of this depth on the ray through the pixel: w is the depth, and the third row gives z for that w.
      const Point near = apply(screen_to_world, {{x + 0.5, y + 0.5, 0, 1}}),
                  far = apply(screen_to_world, {{x + 0.5, y + 0.5, 1, 1}});
      const Matrix view = matrix(now, 0);
      Point a{}, b{};
      for (std::size_t i = 0; i < 4; ++i) a.v[i] = near.v[i] / near.v[3], b.v[i] = far.v[i] / far.v[3];
      const double za = apply(view, a).v[2], zb = apply(view, b).v[2], t = (double(depth.at(0, x, y)) - za) / (zb - za);
      Point p{};
      for (std::size_t i = 0; i < 4; ++i) p.v[i] = a.v[i] + t * (b.v[i] - a.v[i]);
      const Point s = apply(matrix(before, 1), p);
      worst = std::max(worst, std::hypot(s.v[0] / s.v[3] - x - 0.5 - double(motion.at(0, x, y)),
                                         s.v[1] / s.v[3] - y - 0.5 - double(motion.at(1, x, y))));
      ++floor;
    }
  EXPECT_GT(floor, 10000);
  EXPECT_LT(worst, 0.05);  // motion is half in the file
}

TEST_F(RealSequence, CyclesNativeKeepsItsConventions) {
  for (const char* scene : {"cornell-mover", "glossy-hall", "foliage-cut"}) {
    const auto source = open(std::string("cycles-native-") + scene, "cycles-native");
    ASSERT_TRUE(source);
    for (const char* role :
         {"color", "albedo", "normal", "depth", "position", "motion", "id", "emission", "environment", "camera"})
      EXPECT_TRUE(source->roles().contains(role)) << scene << ' ' << role;
    const auto found = agreement(*source, 8);
    EXPECT_GT(found.hits, 1000) << scene;
    EXPECT_LT(found.depth, 1e-3) << scene;
    // Position comes from the first sample, which sits on the pixel's centre.
    EXPECT_LT(found.pixels, 0.05) << scene;
    EXPECT_EQ(source->declared_cut(9), std::string(scene) == "foliage-cut");
  }
}

TEST_F(RealSequence, EveryCompressionReadsAlike) {
  const std::filesystem::path codecs = std::filesystem::path(std::getenv("QUELL_TEST_DATA")) / "cycles-native/codec";
  int read_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(codecs)) {
    Diagnostics diagnostics;
    SequenceRequest request{(entry.path() / "frame_####.exr").string(),
                            {},
                            {},
                            std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/profiles"};
    const auto sequence = load_sequence(request, diagnostics);
    ASSERT_TRUE(sequence) << diagnostics.format();
    const auto source = open_sequence(*sequence, {}, Missing::error, diagnostics);
    ASSERT_TRUE(source) << diagnostics.format();
    double sum = 0;
    const Image color = read_role(*source, 8, "color");
    for (int y = 0; y < color.height(); ++y)
      for (int x = 0; x < color.width(); ++x) sum += double(color.at(1, x, y));
    const Image albedo = read_role(*source, 8, "albedo");
    EXPECT_GT(sum, 0) << entry.path();
    EXPECT_GT(albedo.at(0, 48, 27), 0) << entry.path();
    ++read_files;
  }
  EXPECT_EQ(read_files, 9);
}

}  // namespace
}  // namespace quell::test
