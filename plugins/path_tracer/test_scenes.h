// What the tests of the path tracer share: scene files made of text, and numbers out of images.
#pragma once

#include "tests/support/paths.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <glm/glm.hpp>
#include <set>
#include <string>
#include <vector>

namespace path_tracer_test {

using quell::Image;
using quell::test::Node;

inline const std::string kRoom = QUELL_TEST_SOURCE "/graphs/scenes/room.json";

enum Output {
  kColor,
  kAlbedo,
  kNormal,
  kDepth,
  kPosition,
  kMotion,
  kId,
  kEmission,
  kDiffuse,
  kSpecular,
  kCamera,
  kTransforms
};

// A scene file of this process's own, for tests run beside each other; removed when the process ends.
inline std::string scene_file(const std::string& name, const std::string& text) {
  struct Files {
    std::set<std::string> names;
    ~Files() {
      for (const auto& n : names) std::remove(n.c_str());
    }
  };
  static Files files;
  const std::string file = testing::TempDir() + "quell_path_tracer_" + name + "_" + std::to_string(getpid()) + ".json";
  files.names.insert(file);
  std::ofstream(file) << text;
  return file;
}

inline Node tracer(const std::string& scene, int width, int height, int spp = 1) {
  Node node("path_tracer");
  node.set("scene", scene).set("width", width).set("height", height).set("spp", spp);
  return node;
}

inline glm::dmat4 matrix(const Image& table, int row) {
  glm::dmat4 m;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) m[c][r] = table.at(0, 4 * r + c, row);
  return m;
}

inline glm::dvec3 rgb(const Image& image, int x, int y) {
  return {image.at(0, x, y), image.at(1, x, y), image.at(2, x, y)};
}

inline glm::dvec2 projected(const glm::dmat4& screen, const glm::dvec4& p) {
  const glm::dvec4 q = screen * p;
  return glm::dvec2(q.x, q.y) / q.w;
}

inline double mean(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += image.at(0, x, y) + image.at(1, x, y) + image.at(2, x, y);
  return sum / (3.0 * image.width() * image.height());
}

inline bool same_bits(const Image& a, const Image& b) {
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * sizeof(float)) != 0) return false;
  return a.shape().width == b.shape().width && a.shape().height == b.shape().height && a.channels() == b.channels();
}

inline void expect_same(const std::vector<Image>& a, const std::vector<Image>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(same_bits(a[i], b[i])) << "output " << i;
}

// A camera that looks at the origin; the rest of the file is to follow.
inline const char* const kHead =
    R"({ "quell_scene": 1, "camera": { "position": [0, 0, 4], "target": [0, 0, 0], "fov": 40 },)";

}  // namespace path_tracer_test
