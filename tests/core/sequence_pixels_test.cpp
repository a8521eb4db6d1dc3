// What the roles of a sequence read as: values repaired, filled and converted.
#include "core/sequence/sequence.h"

#include "core/report/error.h"
#include "tests/support/failure.h"
#include "tests/support/run_node.h"
#include "tests/support/sequence_test.h"

#include <quell/types.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace quell::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

const std::vector<std::pair<std::string, float>> kColor = {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}};

using SequencePixels = SequenceTest;

TEST_F(SequencePixels, RepairsRadianceAndCounts) {
  const std::vector<std::vector<float>> planes = {
      {1, kNaN, kInf, -1, -kInf, 1e9f}, {2, 5, 1, 3, 1, 1}, {3, 6, 1, -0.5f, 1, 1}};
  write_planes("c_0.exr", 6, 1, kColor, planes);
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"}})"));
  const Image image = read_role(*source, 0, "color");
  const float expected[3][6] = {{1, 0, 65504, 0, 0, 1e9f}, {2, 0, 1, 3, 1, 1}, {3, 0, 1, 0, 1, 1}};
  for (int c = 0; c < 3; ++c)
    for (int x = 0; x < 6; ++x) EXPECT_EQ(image.at(c, x, 0), expected[c][x]) << c << ' ' << x;
  EXPECT_EQ(source->repairs().at("color").non_finite, 3);
  EXPECT_EQ(source->repairs().at("color").negative, 1);
}

TEST_F(SequencePixels, RefusesWhatIsNotFiniteWhereItMustNotRepair) {
  write("c_0.exr", 6, 2, kColor);
  write_planes("c_1.exr", 3, 2, kColor, {{1, 1, 1, 1, 1, 1}, {2, 2, 2, 2, 2, kInf}, {3, 3, 3, 3, kNaN, 3}});
  write("d_0.exr", 6, 2, kColor);
  write_planes("d_1.exr", 3, 2, kColor, {{kNaN, 1, 1, 1, 1, 1}, {2, 2, 2, 2, 2, 2}, {3, 3, 3, 3, 3, 3}});
  write("z_0.exr", 3, 2, {{"Z", 4}});
  write_planes("z_1.exr", 3, 2, {{"Z", 0}}, {{0, kInf, 1e10f, 4, 4, kNaN}});
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {
    "color": "c_@.exr", "emission": "d_@.exr", "depth": {"file": "z_@.exr"} }})"));
  const std::vector<std::string> strict = {"color", "depth"};
  source->refuse_non_finite(strict);
  EXPECT_EQ(read_role(*source, 0, "color").at(1, 2, 1), 2.0f);
  EXPECT_EQ(read_role(*source, 0, "depth").at(0, 2, 1), 4.0f);
  const std::string way_out = "\n  an error cannot be told from such pixels; repair the file, or leave the frame out";
  EXPECT_EQ(failure(Exit::input, [&] { read_role(*source, 1, "color"); }),
            "frame 1: " + path("c_1.exr") + ": 'color' is not finite: pixel (1, 1) holds nan in channel 'B'" + way_out);
  EXPECT_EQ(failure(Exit::input, [&] { read_role(*source, 1, "depth"); }),
            "frame 1: " + path("z_1.exr") + ": 'depth' is not finite: pixel (2, 1) holds nan in channel 'Z'" + way_out)
      << "an infinite depth is a miss";
  EXPECT_EQ(read_role(*source, 1, "emission").at(0, 0, 0), 0.0f) << "repaired as ever";
}

TEST_F(SequencePixels, FillsWhatTheDataWindowLeavesOpen) {
  OIIO::ImageSpec spec(2, 1, 5, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "Z", "id"};
  spec.x = 1, spec.y = 1, spec.full_width = 4, spec.full_height = 3;
  const std::vector<float> pixels = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  auto out = OIIO::ImageOutput::create("openexr");
  ASSERT_TRUE(out->open(path("w_0.exr"), spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) &&
              out->close());
  const auto source =
      open(load(R"({"quell_sequence": 1, "inputs": {"color": "w_@.exr", "depth": {"file": "w_@.exr", "channels": ["Z"]},
                                    "id": {"file": "w_@.exr", "channels": ["id"]}}})"));
  const std::vector<std::string> roles = {"id", "color", "depth"};
  std::vector<Image> images;
  std::vector<quell_image> views;
  for (const auto& shape : source->shapes(0, roles)) images.emplace_back(shape).fill(kNaN);
  for (const auto& image : images) views.push_back(image.view());
  source->read(0, roles, views);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) {
      const bool in = y == 1 && (x == 1 || x == 2);
      const float first = float(5 * (x - 1));
      EXPECT_EQ(images[0].bits(0, y)[x], in ? std::uint32_t(first) + 5 : kNoId) << x << ' ' << y;
      for (int c = 0; c < 3; ++c) EXPECT_EQ(images[1].at(c, x, y), in ? first + 1 + float(c) : 0.0f) << x << ' ' << y;
      EXPECT_EQ(images[2].at(0, x, y), in ? first + 4 : kFar) << x << ' ' << y;
    }
}

TEST_F(SequencePixels, MakesEncodedColorsLinear) {
  const std::vector<std::uint8_t> pixels = {0, 188, 255};
  auto out = OIIO::ImageOutput::create("png");
  ASSERT_TRUE(out->open(path("p_0.png"), OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::UINT8)) &&
              out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && out->close());
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "p_@.png", "display": "p_@.png"}})"));
  const Image color = read_role(*source, 0, "color"), display = read_role(*source, 0, "display");
  EXPECT_EQ(color.at(0, 0, 0), 0.0f);
  EXPECT_NEAR(color.at(1, 0, 0), 0.5029, 1e-4);  // IEC 61966-2-1: ((188/255 + 0.055)/1.055)^2.4
  EXPECT_EQ(color.at(2, 0, 0), 1.0f);
  EXPECT_FLOAT_EQ(display.at(1, 0, 0), 188.0f / 255);
}

// OpenEXR's parts share a display window; pages of other formats need not.
TEST_F(SequencePixels, RefusesChannelsOfUnlikeParts) {
  const std::vector<float> pixels(6);
  auto out = OIIO::ImageOutput::create("tiff");
  ASSERT_TRUE(out->open(path("u_0.tif"), OIIO::ImageSpec(2, 2, 1, OIIO::TypeDesc::FLOAT)) &&
              out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
  ASSERT_TRUE(
      out->open(path("u_0.tif"), OIIO::ImageSpec(3, 2, 1, OIIO::TypeDesc::FLOAT), OIIO::ImageOutput::AppendSubimage) &&
      out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && out->close());
  const auto source =
      open(load(R"({"quell_sequence": 1, "inputs": {"motion": {"file": "u_@.tif", "channels": ["0.Y", "1.Y"]}}})"));
  EXPECT_EQ(
      failure(Exit::input, [&] { read_role(*source, 0, "motion"); }),
      "frame 0: " + path("u_0.tif") + ": channels '0.Y' and '1.Y' have display windows of 2 x 2 and 3 x 2 pixels");
}

TEST_F(SequencePixels, TurnsEveryMissOfDepthIntoFar) {
  write_planes("z_0.exr", 6, 1, {{"Z", 0}}, {{0, kInf, 1e10f, kNaN, 4, 77}});
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"depth": {"file": "z_@.exr", "miss": 77}}})"));
  const Image image = read_role(*source, 0, "depth");
  for (const int x : {0, 1, 2, 3, 5}) EXPECT_EQ(image.at(0, x, 0), kFar) << x;
  EXPECT_EQ(image.at(0, 4, 0), 4.0f);
  EXPECT_EQ(source->repairs().at("depth").non_finite, 1);
}

TEST_F(SequencePixels, ConvertsMotion) {
  write("m_0.exr", 8, 4, {{"X", 0.25f}, {"Y", 0.5f}});
  const auto value = [&](const std::string& keys) {
    const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"motion": {"file": "m_@.exr")" + keys + "}}}"));
    const Image image = read_role(*source, 0, "motion");
    return std::pair(image.at(0, 7, 3), image.at(1, 7, 3));
  };
  EXPECT_EQ(value(""), std::pair(0.25f, 0.5f));
  EXPECT_EQ(value(R"(, "flip_y": true)"), std::pair(0.25f, -0.5f));
  EXPECT_EQ(value(R"(, "negate": true, "flip_y": true)"), std::pair(-0.25f, 0.5f));
  EXPECT_EQ(value(R"(, "scale": 2)"), std::pair(0.5f, 1.0f));
  EXPECT_EQ(value(R"(, "scale": [4, -2])"), std::pair(1.0f, -1.0f));
  EXPECT_EQ(value(R"(, "scale": "size")"), std::pair(2.0f, 2.0f));
  EXPECT_EQ(value(R"(, "encoded": true)"), std::pair(-0.5f, 0.0f));
}

TEST_F(SequencePixels, ConvertsNormals) {
  write_planes("n_0.exr", 3, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0, 0, kNaN}, {3, 0, 0}, {4, 0, 1}});
  Image image = read_role(*open(load(R"({"quell_sequence": 1, "inputs": {"normal": "n_@.exr"}})")), 0, "normal");
  EXPECT_FLOAT_EQ(image.at(1, 0, 0), 0.6f);
  EXPECT_FLOAT_EQ(image.at(2, 0, 0), 0.8f);
  for (int c = 0; c < 3; ++c)
    for (const int x : {1, 2}) EXPECT_EQ(image.at(c, x, 0), 0.0f);

  const float none = 127.0f / 255;  // the nearest that eight bits come to no direction
  write_planes("e_0.exr", 2, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0.5f, none}, {0.5f, none}, {1, none}});
  image = read_role(*open(load(R"({"quell_sequence": 1, "inputs": {"normal": {"file": "e_@.exr", "encoded": true}}})")),
                    0, "normal");
  EXPECT_EQ(image.at(2, 0, 0), 1.0f);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(c, 1, 0), 0.0f);
}

TEST_F(SequencePixels, ReadsIds) {
  write_planes("i_0.exr", 4, 1, {{"Y", 0}}, {{0, 6, -1, kNaN}});
  Image image = read_role(*open(load(R"({"quell_sequence": 1, "inputs": {"id": "i_@.exr"}})")), 0, "id");
  EXPECT_EQ(std::vector(image.bits(0, 0), image.bits(0, 0) + 4), (std::vector<std::uint32_t>{0, 6, kNoId, kNoId}));
  image = read_role(*open(load(R"({"quell_sequence": 1, "inputs": {"id": {"file": "i_@.exr", "miss": 0}}})")), 0, "id");
  EXPECT_EQ(std::vector(image.bits(0, 0), image.bits(0, 0) + 4), (std::vector<std::uint32_t>{kNoId, 6, kNoId, kNoId}));
}

TEST_F(SequencePixels, TurnsDistanceIntoDepth) {
  write_camera("m_0.mat");
  const int width = 16, height = 12;
  std::vector<float> distance;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      distance.push_back(float(5 * std::hypot((x + 0.5 - 8) / 10, (y + 0.5 - 6) / 10, 1.0)));
  distance[0] = kInf;
  write_planes("d_0.exr", width, height, {{"Z", 0}}, {distance});
  const auto sequence = load(R"({"quell_sequence": 1, "inputs": {"depth": {"file": "d_@.exr", "distance": true},
                                 "camera": {"file": "m_@.mat", "format": "games202"}}})");
  const Image image = read_role(*open(sequence, Missing::error, {"depth"}), 0, "depth");
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ASSERT_NEAR(image.at(0, x, y), x + y > 0 ? 5.0f : kFar, 1e-5f) << x << ' ' << y;
}

TEST_F(SequencePixels, TakesCameraSpaceToTheWorld) {
  write_camera("m_0.mat");
  write_planes("n_0.exr", 1, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0}, {0}, {2}});
  write_planes("p_0.exr", 2, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0.5f, 1}, {0, 2}, {4, 3}});
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {
      "normal": {"file": "n_@.exr", "space": "camera"}, "position": {"file": "p_@.exr", "space": "camera"},
      "camera": {"file": "m_@.mat", "format": "games202"}}})"));
  const Image normal = read_role(*source, 0, "normal"), position = read_role(*source, 0, "position");
  EXPECT_FLOAT_EQ(normal.at(0, 0, 0), 1.0f);  // forward is world +x
  EXPECT_FLOAT_EQ(normal.at(2, 0, 0), 0.0f);
  EXPECT_FLOAT_EQ(position.at(0, 0, 0), 5.0f);
  EXPECT_FLOAT_EQ(position.at(1, 0, 0), 2.0f);
  EXPECT_FLOAT_EQ(position.at(2, 0, 0), 2.5f);
  const auto world = open(load(R"({"quell_sequence": 1, "inputs": {"position": {"file": "p_@.exr", "miss": "camera"},
                                   "camera": {"file": "m_@.mat", "format": "games202"}}})"));
  const Image kept = read_role(*world, 0, "position");
  EXPECT_EQ(kept.at(2, 0, 0), 4.0f);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(kept.at(c, 1, 0), 0.0f);
}

TEST_F(SequencePixels, ReadsMatrices) {
  write_camera("m_0.mat");
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"camera": {"file": "m_@.mat", "format": "games202"},
                                    "transforms": {"file": "m_@.mat", "format": "games202"}}})"));
  const Image camera = read_role(*source, 0, "camera");
  EXPECT_EQ(camera.width(), 16);
  EXPECT_EQ(camera.height(), 2);
  EXPECT_EQ(camera.at(0, 2, 0), -1.0f);
  EXPECT_EQ(camera.at(0, 3, 0), 3.0f);
  const Image transforms = read_role(*source, 0, "transforms");
  EXPECT_EQ(transforms.height(), 1);  // no object: one identity
  EXPECT_EQ(transforms.at(0, 5, 0), 1.0f);
  std::filesystem::resize_file(path("m_0.mat"), 131);
  const auto broken =
      open(load(R"({"quell_sequence": 1, "inputs": {"transforms": {"file": "m_@.mat", "format": "games202"}}})"));
  EXPECT_EQ(failure(Exit::input, [&] { read_role(*broken, 0, "transforms"); }),
            "frame 0: " + path("m_0.mat") + ": has 131 bytes in place of the 132 that 0 objects and a camera take");
}

}  // namespace
}  // namespace quell::test
