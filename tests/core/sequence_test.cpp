// Sequences of files: which frames there are, what their roles read as, and what happens when files are missing or
// change.
#include "core/sequence/sequence.h"

#include "core/image/image.h"
#include "core/report/error.h"
#include "core/sequence/profile.h"
#include "tests/support/paths.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace quell {
namespace {

using Frames = std::vector<std::int64_t>;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// A folder with files of a sequence, and the ways to it.
class SequenceTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.path(name); }

  using Channels = std::vector<std::pair<std::string, float>>;

  // An image with the same value in all of a channel.
  void write(const std::string& name, int width, int height, const Channels& channels) {
    std::vector<std::vector<float>> planes;
    for (const auto& [channel, value] : channels) planes.emplace_back(std::size_t(width) * std::size_t(height), value);
    write_planes(name, width, height, channels, planes);
  }
  // An image with channels by these names (their values are of no meaning here) and the planes' values.
  void write_planes(const std::string& name, int width, int height, const Channels& channels,
                    const std::vector<std::vector<float>>& planes) {
    OIIO::ImageSpec spec(width, height, int(channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames.clear();
    for (const auto& [channel, value] : channels) spec.channelnames.push_back(channel);
    std::vector<float> pixels;
    for (std::size_t i = 0; i < planes[0].size(); ++i)
      for (const auto& plane : planes) pixels.push_back(plane[i]);
    auto out = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(out->open(path(name), spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && out->close());
  }

  Sequence load(const std::string& json, std::optional<std::string> frames = {}) {
    std::ofstream(path("sequence.json")) << json;
    return load_path(path("sequence.json"), std::move(frames));
  }
  Sequence load_path(const std::string& file, std::optional<std::string> frames = {}) {
    SequenceRequest request{file, std::move(frames), {}, profiles()};
    auto sequence = load_sequence(request, diagnostics_);
    if (!sequence) throw std::runtime_error(diagnostics_.format());
    return std::move(*sequence);
  }
  std::unique_ptr<FileSequence> open(const Sequence& sequence, Missing missing = Missing::error,
                                     const std::vector<std::string>& roles = {}) {
    auto source = open_sequence(sequence, roles, missing, diagnostics_);
    if (!source) throw std::runtime_error(diagnostics_.format());
    return source;
  }
  static Image read(FrameSource& source, std::int64_t frame, const std::string& role) {
    const std::vector<std::string> roles = {role};
    Image image(source.shapes(frame, roles).at(0));
    const quell_image view = image.view();
    source.read(frame, roles, {&view, 1});
    return image;
  }
  static std::filesystem::path profiles() { return std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/profiles"; }

  test::Scratch scratch_;
  Diagnostics diagnostics_;
};

template <class Action>
std::string failure(Action action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::input) << e.what();
    return e.what();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

const std::vector<std::pair<std::string, float>> kColor = {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}};

TEST_F(SequenceTest, FindsItsFramesOnTheDisk) {
  for (const char* name : {"c_1.exr", "c_2.exr", "c_10.exr"}) write(name, 4, 3, kColor);
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"}})"));
  EXPECT_EQ(source->frames(), (Frames{1, 2, 10}));
  EXPECT_EQ(source->roles(), (std::map<std::string, int>{{"color", QUELL_RADIANCE}}));
  EXPECT_EQ(read(*source, 2, "color").at(2, 3, 2), 3.0f);
}

TEST_F(SequenceTest, CutsAreDeclaredOrGaps) {
  for (int i = 1; i <= 8; ++i) write("c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  const auto source =
      open(load(R"({"quell_sequence": 1, "frames": "1-3,5-8", "cuts": [7], "inputs": {"color": "c_@.exr"}})"));
  Frames cuts;
  for (const auto frame : source->frames())
    if (source->cut_before(frame)) cuts.push_back(frame);
  EXPECT_EQ(cuts, (Frames{1, 5, 7}));
  EXPECT_TRUE(source->declared_cut(7));
  EXPECT_FALSE(source->declared_cut(5));
  const auto backwards = open(load(R"({"quell_sequence": 1, "frames": "3-1", "inputs": {"color": "c_@.exr"}})"));
  EXPECT_TRUE(backwards->cut_before(2));
}

TEST_F(SequenceTest, TheCommandLineChoosesFramesAndRoot) {
  std::filesystem::create_directory(path("elsewhere"));
  for (int i = 0; i < 4; ++i) write("elsewhere/c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  std::ofstream(path("s.json"))
      << R"({"quell_sequence": 1, "root": "nowhere", "frames": "0-3", "inputs": {"color": "c_@.exr"}})";
  Diagnostics diagnostics;
  const auto sequence = load_sequence({path("s.json"), "2-3", path("elsewhere"), profiles()}, diagnostics);
  ASSERT_TRUE(sequence) << diagnostics.format();
  EXPECT_EQ(open(*sequence)->frames(), (Frames{2, 3}));
  EXPECT_FALSE(load_sequence({path("s.json"), "2-", {}, profiles()}, diagnostics));
  EXPECT_EQ(
      diagnostics.format(),
      "--frames: error: '2-' is no frame range: write a frame, first-last or first-lastxstep, with commas between\n");
}

TEST_F(SequenceTest, NamesAMissingFrameAndItsFile) {
  for (const int i : {0, 1, 3, 5}) write("c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  const auto sequence = load(R"({"quell_sequence": 1, "frames": "0-5", "inputs": {"color": "c_@.exr"}})");
  EXPECT_EQ(failure([&] { open(sequence); }), "frame 2: color: " + path("c_2.exr") +
                                                  ": there is no such file\n  frames without all their files: 2,4\n"
                                                  "  --missing skip, hold or black goes on without");
  const auto none = load(R"({"quell_sequence": 1, "frames": "7-8", "inputs": {"color": "c_@.exr"}})");
  EXPECT_EQ(failure([&] { open(none, Missing::hold); }),
            "frame 7: color: " + path("c_7.exr") + ": there is no such file\n  frames without all their files: 7-8");
}

TEST_F(SequenceTest, GoesOnWithoutMissingFrames) {
  for (const int i : {0, 1, 3, 4})
    write("c_" + std::to_string(i) + ".exr", 2, 2, {{"R", float(i)}, {"G", 0}, {"B", 0}});
  for (int i = 0; i < 5; ++i) write("z_" + std::to_string(i) + ".exr", 2, 2, {{"Z", 10.0f + float(i)}});
  const auto sequence =
      load(R"({"quell_sequence": 1, "frames": "0-4", "inputs": {"color": "c_@.exr", "depth": "z_@.exr"}})");

  const auto skip = open(sequence, Missing::skip);
  EXPECT_EQ(skip->frames(), (Frames{0, 1, 3, 4}));
  EXPECT_TRUE(skip->cut_before(3));
  EXPECT_FALSE(skip->cut_before(4));

  const auto hold = open(sequence, Missing::hold);
  EXPECT_EQ(hold->frames(), (Frames{0, 1, 2, 3, 4}));
  EXPECT_FALSE(hold->cut_before(2));
  EXPECT_EQ(read(*hold, 2, "color").at(0, 0, 0), 1.0f);
  EXPECT_EQ(read(*hold, 2, "depth").at(0, 0, 0), 12.0f);

  const auto black = open(sequence, Missing::black);
  EXPECT_EQ(black->frames(), (Frames{0, 1, 2, 3, 4}));
  EXPECT_TRUE(black->cut_before(2));
  EXPECT_TRUE(black->cut_before(3));
  EXPECT_FALSE(black->cut_before(4));
  EXPECT_EQ(read(*black, 2, "color").at(0, 0, 0), 0.0f);
  EXPECT_EQ(read(*black, 2, "depth").at(0, 0, 0), kFar);
  EXPECT_EQ(black->missing_frames(), Frames{2});

  // What no graph reads need not be there.
  EXPECT_EQ(open(sequence, Missing::error, {"depth"})->frames().size(), 5u);
}

TEST_F(SequenceTest, NamesChannelsThatAreNotThere) {
  write("c_0.exr", 2, 2, {{"Layer.Deep.Z", 1}, {"Layer.Depth.Z", 1}, {"R", 1}});
  const auto text = failure([&] {
    open(load(
        R"({"quell_sequence": 1, "inputs": {"depth": {"file": "c_@.exr", "channels": ["Layer.Depht.Z"]}, "color": "c_@.exr"}})"));
  });
  EXPECT_EQ(text, path("sequence.json") + ":1:75: error: inputs.depth: '" + path("c_0.exr") +
                      "' has no channel 'Layer.Depht.Z'\n  it has: R, Layer.Deep.Z, Layer.Depth.Z. Did you mean "
                      "'Layer.Depth.Z'?\n" +
                      path("sequence.json") + ":1:104: error: inputs.color: '" + path("c_0.exr") +
                      "' has no channels by the usual names of radiance\n  usual names: R G B, r g b\n"
                      "  it has: R, Layer.Deep.Z, Layer.Depth.Z\n  name them with \"channels\"\n");
}

TEST_F(SequenceTest, NamesAFrameThatCannotBeRead) {
  write("c_0.exr", 40, 30, kColor);
  write("c_1.exr", 40, 30, {{"R", 1}, {"G", 2}, {"b", 3}});
  std::filesystem::copy(path("c_0.exr"), path("c_2.exr"));
  std::filesystem::resize_file(path("c_2.exr"), std::filesystem::file_size(path("c_2.exr")) - 9);
  const auto source = open(load(R"({"quell_sequence": 1, "frames": "0-2", "inputs": {"color": "c_@.exr"}})"));
  EXPECT_EQ(failure([&] { read(*source, 1, "color"); }),
            "frame 1: " + path("c_1.exr") +
                ": has no channel 'B', unlike the first frame\n  it has: R, G, b. Did you mean 'b'?");
  EXPECT_TRUE(
      failure([&] { read(*source, 2, "color"); }).starts_with("frame 2: " + path("c_2.exr") + ": cannot be read: "));
  EXPECT_EQ(read(*source, 0, "color").at(1, 39, 29), 2.0f);
}

TEST_F(SequenceTest, SaysWhatShapeEachFrameHas) {
  write("c_0.exr", 4, 3, kColor);
  write("c_1.exr", 6, 5, kColor);
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"}})"));
  const std::vector<std::string> roles = {"color"};
  EXPECT_EQ(source->shapes(0, roles)[0].width, 4);
  EXPECT_EQ(source->shapes(1, roles)[0].width, 6);
  EXPECT_EQ(source->shapes(1, roles)[0].height, 5);
  EXPECT_EQ(source->shapes(1, roles)[0].channels, 3);
}

TEST_F(SequenceTest, RepairsRadianceAndCounts) {
  const std::vector<std::vector<float>> planes = {
      {1, kNaN, kInf, -1, -kInf, 1e9f}, {2, 5, 1, 3, 1, 1}, {3, 6, 1, -0.5f, 1, 1}};
  write_planes("c_0.exr", 6, 1, kColor, planes);
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"}})"));
  const Image image = read(*source, 0, "color");
  const float expected[3][6] = {{1, 0, 65504, 0, 0, 1e9f}, {2, 0, 1, 3, 1, 1}, {3, 0, 1, 0, 1, 1}};
  for (int c = 0; c < 3; ++c)
    for (int x = 0; x < 6; ++x) EXPECT_EQ(image.at(c, x, 0), expected[c][x]) << c << ' ' << x;
  EXPECT_EQ(source->repairs().at("color").non_finite, 3);
  EXPECT_EQ(source->repairs().at("color").negative, 1);
}

TEST_F(SequenceTest, RefusesWhatIsNotFiniteWhereItMustNotRepair) {
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
  EXPECT_EQ(read(*source, 0, "color").at(1, 2, 1), 2.0f);
  EXPECT_EQ(read(*source, 0, "depth").at(0, 2, 1), 4.0f);
  const std::string way_out = "\n  an error cannot be told from such pixels; repair the file, or leave the frame out";
  EXPECT_EQ(failure([&] { read(*source, 1, "color"); }),
            "frame 1: " + path("c_1.exr") + ": 'color' is not finite: pixel (1, 1) holds nan in channel 'B'" + way_out);
  EXPECT_EQ(failure([&] { read(*source, 1, "depth"); }),
            "frame 1: " + path("z_1.exr") + ": 'depth' is not finite: pixel (2, 1) holds nan in channel 'Z'" + way_out)
      << "an infinite depth is a miss";
  EXPECT_EQ(read(*source, 1, "emission").at(0, 0, 0), 0.0f) << "repaired as ever";
}

TEST_F(SequenceTest, FillsWhatTheDataWindowLeavesOpen) {
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

TEST_F(SequenceTest, MakesEncodedColorsLinear) {
  const std::vector<std::uint8_t> pixels = {0, 188, 255};
  auto out = OIIO::ImageOutput::create("png");
  ASSERT_TRUE(out->open(path("p_0.png"), OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::UINT8)) &&
              out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && out->close());
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "p_@.png", "display": "p_@.png"}})"));
  const Image color = read(*source, 0, "color"), display = read(*source, 0, "display");
  EXPECT_EQ(color.at(0, 0, 0), 0.0f);
  EXPECT_NEAR(color.at(1, 0, 0), 0.5029, 1e-4);  // IEC 61966-2-1: ((188/255 + 0.055)/1.055)^2.4
  EXPECT_EQ(color.at(2, 0, 0), 1.0f);
  EXPECT_FLOAT_EQ(display.at(1, 0, 0), 188.0f / 255);
}

// OpenEXR's parts share a display window; pages of other formats need not.
TEST_F(SequenceTest, RefusesChannelsOfUnlikeParts) {
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
      failure([&] { read(*source, 0, "motion"); }),
      "frame 0: " + path("u_0.tif") + ": channels '0.Y' and '1.Y' have display windows of 2 x 2 and 3 x 2 pixels");
}

TEST_F(SequenceTest, TurnsEveryMissOfDepthIntoFar) {
  write_planes("z_0.exr", 6, 1, {{"Z", 0}}, {{0, kInf, 1e10f, kNaN, 4, 77}});
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"depth": {"file": "z_@.exr", "miss": 77}}})"));
  const Image image = read(*source, 0, "depth");
  for (const int x : {0, 1, 2, 3, 5}) EXPECT_EQ(image.at(0, x, 0), kFar) << x;
  EXPECT_EQ(image.at(0, 4, 0), 4.0f);
  EXPECT_EQ(source->repairs().at("depth").non_finite, 1);
}

TEST_F(SequenceTest, ConvertsMotion) {
  write("m_0.exr", 8, 4, {{"X", 0.25f}, {"Y", 0.5f}});
  const auto value = [&](const std::string& keys) {
    const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"motion": {"file": "m_@.exr")" + keys + "}}}"));
    const Image image = read(*source, 0, "motion");
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

TEST_F(SequenceTest, ConvertsNormals) {
  write_planes("n_0.exr", 3, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0, 0, kNaN}, {3, 0, 0}, {4, 0, 1}});
  Image image = read(*open(load(R"({"quell_sequence": 1, "inputs": {"normal": "n_@.exr"}})")), 0, "normal");
  EXPECT_FLOAT_EQ(image.at(1, 0, 0), 0.6f);
  EXPECT_FLOAT_EQ(image.at(2, 0, 0), 0.8f);
  for (int c = 0; c < 3; ++c)
    for (const int x : {1, 2}) EXPECT_EQ(image.at(c, x, 0), 0.0f);

  const float none = 127.0f / 255;  // the nearest that eight bits come to no direction
  write_planes("e_0.exr", 2, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0.5f, none}, {0.5f, none}, {1, none}});
  image = read(*open(load(R"({"quell_sequence": 1, "inputs": {"normal": {"file": "e_@.exr", "encoded": true}}})")), 0,
               "normal");
  EXPECT_EQ(image.at(2, 0, 0), 1.0f);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(c, 1, 0), 0.0f);
}

TEST_F(SequenceTest, ReadsIds) {
  write_planes("i_0.exr", 4, 1, {{"Y", 0}}, {{0, 6, -1, kNaN}});
  Image image = read(*open(load(R"({"quell_sequence": 1, "inputs": {"id": "i_@.exr"}})")), 0, "id");
  EXPECT_EQ(std::vector(image.bits(0, 0), image.bits(0, 0) + 4), (std::vector<std::uint32_t>{0, 6, kNoId, kNoId}));
  image = read(*open(load(R"({"quell_sequence": 1, "inputs": {"id": {"file": "i_@.exr", "miss": 0}}})")), 0, "id");
  EXPECT_EQ(std::vector(image.bits(0, 0), image.bits(0, 0) + 4), (std::vector<std::uint32_t>{kNoId, 6, kNoId, kNoId}));
}

// A camera at (1, 2, 3) that looks along world +x with y up, and projects as a pinhole of focal length 10 pixels.
void write_camera(const std::string& file) {
  const float view[16] = {0, 0, -1, 3, 0, 1, 0, -2, 1, 0, 0, -1, 0, 0, 0, 1};
  const float pinhole[16] = {10, 0, 8, 0, 0, -10, 6, 0, 0, 0, 1, -0.1f, 0, 0, 1, 0};
  float screen[16] = {};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 4; ++k) screen[4 * r + c] += pinhole[4 * r + k] * view[4 * k + c];
  const std::int32_t n = 0;
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&n), 4)
      .write(reinterpret_cast<const char*>(view), 64)
      .write(reinterpret_cast<const char*>(screen), 64);
}

TEST_F(SequenceTest, TurnsDistanceIntoDepth) {
  write_camera(path("m_0.mat"));
  const int width = 16, height = 12;
  std::vector<float> distance;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      distance.push_back(float(5 * std::hypot((x + 0.5 - 8) / 10, (y + 0.5 - 6) / 10, 1.0)));
  distance[0] = kInf;
  write_planes("d_0.exr", width, height, {{"Z", 0}}, {distance});
  const auto sequence = load(R"({"quell_sequence": 1, "inputs": {"depth": {"file": "d_@.exr", "distance": true},
                                 "camera": {"file": "m_@.mat", "format": "games202"}}})");
  const Image image = read(*open(sequence, Missing::error, {"depth"}), 0, "depth");
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ASSERT_NEAR(image.at(0, x, y), x + y > 0 ? 5.0f : kFar, 1e-5f) << x << ' ' << y;
}

TEST_F(SequenceTest, TakesCameraSpaceToTheWorld) {
  write_camera(path("m_0.mat"));
  write_planes("n_0.exr", 1, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0}, {0}, {2}});
  write_planes("p_0.exr", 2, 1, {{"X", 0}, {"Y", 0}, {"Z", 0}}, {{0.5f, 1}, {0, 2}, {4, 3}});
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {
      "normal": {"file": "n_@.exr", "space": "camera"}, "position": {"file": "p_@.exr", "space": "camera"},
      "camera": {"file": "m_@.mat", "format": "games202"}}})"));
  const Image normal = read(*source, 0, "normal"), position = read(*source, 0, "position");
  EXPECT_FLOAT_EQ(normal.at(0, 0, 0), 1.0f);  // forward is world +x
  EXPECT_FLOAT_EQ(normal.at(2, 0, 0), 0.0f);
  EXPECT_FLOAT_EQ(position.at(0, 0, 0), 5.0f);
  EXPECT_FLOAT_EQ(position.at(1, 0, 0), 2.0f);
  EXPECT_FLOAT_EQ(position.at(2, 0, 0), 2.5f);
  const auto world = open(load(R"({"quell_sequence": 1, "inputs": {"position": {"file": "p_@.exr", "miss": "camera"},
                                   "camera": {"file": "m_@.mat", "format": "games202"}}})"));
  const Image kept = read(*world, 0, "position");
  EXPECT_EQ(kept.at(2, 0, 0), 4.0f);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(kept.at(c, 1, 0), 0.0f);
}

TEST_F(SequenceTest, ReadsMatrices) {
  write_camera(path("m_0.mat"));
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"camera": {"file": "m_@.mat", "format": "games202"},
                                    "transforms": {"file": "m_@.mat", "format": "games202"}}})"));
  const Image camera = read(*source, 0, "camera");
  EXPECT_EQ(camera.width(), 16);
  EXPECT_EQ(camera.height(), 2);
  EXPECT_EQ(camera.at(0, 2, 0), -1.0f);
  EXPECT_EQ(camera.at(0, 3, 0), 3.0f);
  const Image transforms = read(*source, 0, "transforms");
  EXPECT_EQ(transforms.height(), 1);  // no object: one identity
  EXPECT_EQ(transforms.at(0, 5, 0), 1.0f);
  std::filesystem::resize_file(path("m_0.mat"), 131);
  const auto broken =
      open(load(R"({"quell_sequence": 1, "inputs": {"transforms": {"file": "m_@.mat", "format": "games202"}}})"));
  EXPECT_EQ(failure([&] { read(*broken, 0, "transforms"); }),
            "frame 0: " + path("m_0.mat") + ": has 131 bytes in place of the 132 that 0 objects and a camera take");
}

TEST_F(SequenceTest, ExposesSourceNodes) {
  const auto sequence =
      load(R"({"quell_sequence": 1, "frames": "0-2", "source": {"type": "room", "set": {"spp": 2}}})");
  ASSERT_TRUE(sequence.source);
  EXPECT_EQ(sequence.source->type, "room");
  ASSERT_TRUE(sequence.source->set);
  EXPECT_EQ(sequence.source->set->find("spp")->integer, 2);
  EXPECT_EQ(sequence.frames, (Frames{0, 1, 2}));
}

TEST_F(SequenceTest, TheBuiltInSequencesHaveSourcesForFramesAndReference) {
  const auto folder = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/sequences";
  int found = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const Sequence sequence = load_path(file.path().string());
    ASSERT_TRUE(sequence.source) << file.path();
    ASSERT_EQ(sequence.reference_sources.size(), 2u) << file.path();
    EXPECT_EQ(sequence.source->type, "path_tracer");
    EXPECT_EQ(sequence.reference_sources[0].role, "reference_a");
    EXPECT_EQ(sequence.reference_sources[1].role, "reference_b");
    const auto seed = [](const SourceNode& node) {
      const Json* j = node.set->find("seed");
      return j ? j->integer : 0;
    };
    EXPECT_NE(seed(sequence.reference_sources[0].node), seed(sequence.reference_sources[1].node));
    for (const auto& half : sequence.reference_sources) {
      EXPECT_NE(seed(half.node), seed(*sequence.source)) << "the noise of the frames must not be in their reference";
      EXPECT_EQ(half.node.set->find("spp")->integer, 512);
    }
    EXPECT_GE(sequence.frames.size(), 16u);
    ++found;
  }
  EXPECT_GE(found, 5);
}

TEST_F(SequenceTest, ReadsReferencesWhereThereAreSome) {
  for (int i = 0; i < 4; ++i) write("c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  for (const char* half : {"a", "b"})
    write("ref_2_" + std::string(half) + ".exr", 2, 2, {{"R", 7}, {"G", 8}, {"B", 9}});
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"},
                                    "reference": {"A": "ref_@_a.exr", "B": "ref_@_b.exr"}})"));
  EXPECT_EQ(source->reference_frames(), Frames{2});
  EXPECT_EQ(read(*source, 2, "reference_b").at(2, 0, 0), 9.0f);
  EXPECT_EQ(source->frames().size(), 4u);
}

TEST_F(SequenceTest, RecognisesALoneImage) {
  for (int i = 1; i <= 2; ++i) {
    write("r." + std::string("000") + std::to_string(i) + ".exr", 3, 2,
          {{"View Layer.Combined.R", 1},
           {"View Layer.Combined.G", 2},
           {"View Layer.Combined.B", 3},
           {"View Layer.Depth.Z", 1e10f},
           {"View Layer.Vector.X", 5},
           {"View Layer.Vector.Y", 6},
           {"View Layer.Denoising Normal.X", 1},
           {"View Layer.Denoising Normal.Y", 0},
           {"View Layer.Denoising Normal.Z", 0}});
  }
  const auto source = open(load_path(path("r.####.exr")));
  EXPECT_EQ(source->frames(), (Frames{1, 2}));
  // The normal is in camera space, and there is no camera.
  EXPECT_EQ(source->roles(),
            (std::map<std::string, int>{{"color", QUELL_RADIANCE}, {"depth", QUELL_DEPTH}, {"motion", QUELL_MOTION}}));
  EXPECT_EQ(read(*source, 1, "motion").at(1, 0, 0), -6.0f);
  EXPECT_EQ(read(*source, 1, "depth").at(0, 0, 0), kFar);
}

TEST_F(SequenceTest, ListsWhatAnUnknownImageHas) {
  write("r.0001.exr", 3, 2, {{"left.one", 1}, {"left.two", 1}});
  EXPECT_EQ(
      failure([&] { load_path(path("r.####.exr")); }),
      "error: no profile knows the channels of '" + path("r.0001.exr") +
          "'\n  it has: left.one, left.two\n  profiles tried: bmfr, cycles, falcor, games202, mitsuba, pbrt, plain\n"
          "  a sequence file can say which channel plays which role\n");
  EXPECT_EQ(failure([&] { load_path(path("none.####.exr")); }), "no file is called '" + path("none.####.exr") + "'");
}

TEST_F(SequenceTest, RecognisesAFolder) {
  for (int i = 0; i < 2; ++i) {
    write("beauty_" + std::to_string(i) + ".exr", 3, 2, kColor);
    write_camera(path("matrix_" + std::to_string(i) + ".mat"));
  }
  const auto source = open(load_path(scratch_.folder()));
  EXPECT_EQ(source->frames(), (Frames{0, 1}));
  EXPECT_EQ(source->roles(),
            (std::map<std::string, int>{
                {"camera", QUELL_CAMERA}, {"color", QUELL_RADIANCE}, {"transforms", QUELL_TRANSFORMS}}));
}

TEST_F(SequenceTest, LaysADocumentOverAProfile) {
  write("mvec.0.exr", 8, 4, {{"R", 0.25f}, {"G", 0.5f}});
  const auto value = [&](const std::string& keys) {
    const auto source = open(load(
        R"({"quell_sequence": 1, "profile": "falcor", "inputs": {"motion": {"file": "mvec.@.exr")" + keys + "}}}"));
    return read(*source, 0, "motion").at(0, 0, 0);
  };
  EXPECT_EQ(value(""), 2.0f);  // Falcor's fractions of the width
  EXPECT_EQ(value(R"(, "scale": 4)"), 1.0f);
  EXPECT_EQ(value(R"(, "channels": ["G", "R"])"), 0.5f);
}

TEST(Profiles, AreWithoutMistakes) {
  const std::filesystem::path folder = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/profiles";
  const auto names = profile_names(folder);
  EXPECT_GE(names.size(), 7u);
  for (const auto& name : names) {
    Diagnostics diagnostics;
    const auto profile = load_profile(folder, name, diagnostics);
    ASSERT_TRUE(profile) << diagnostics.format();
    EXPECT_FALSE(profile->about.empty() || profile->inputs.empty()) << name;
  }
}

}  // namespace
}  // namespace quell
