// Images from files, whatever the format's layout; damage is an error.
#include "core/sequence/image_file.h"

#include "core/sequence/image_writer.h"
#include "tests/support/failure.h"
#include "tests/support/read_channels.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"

#include <quell/types.h>

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

namespace quell::test {
namespace {

// Value of channel c at a pixel of the file's own coordinates, exact in half.
float value_at(int c, int x, int y) { return float(c * 256 + (x & 15) * 16 + (y & 15)); }

// A file with one part a spec; channel c of part p holds value_at(c + 4 p, …).
void write_parts(const std::string& path, std::vector<OIIO::ImageSpec> specs) {
  auto out = OIIO::ImageOutput::create("openexr");
  ASSERT_TRUE(out);
  for (std::size_t p = 0; p < specs.size(); ++p) {
    const auto& spec = specs[p];
    const bool good = specs.size() == 1 ? out->open(path, spec)
                      : p == 0          ? out->open(path, int(specs.size()), specs.data())
                                        : out->open(path, spec, OIIO::ImageOutput::AppendSubimage);
    ASSERT_TRUE(good) << out->geterror();
    std::vector<float> pixels;
    for (int y = spec.y; y < spec.y + spec.height; ++y)
      for (int x = spec.x; x < spec.x + spec.width; ++x)
        for (int c = 0; c < spec.nchannels; ++c) pixels.push_back(value_at(c + 4 * int(p), x, y));
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << out->geterror();
  }
  ASSERT_TRUE(out->close()) << out->geterror();
}

OIIO::ImageSpec spec_of(int width, int height, std::vector<std::string> names,
                        OIIO::TypeDesc type = OIIO::TypeDesc::HALF) {
  OIIO::ImageSpec spec(width, height, int(names.size()), type);
  spec.channelnames = std::move(names);
  return spec;
}

TEST(ImageFile, ReadsEveryStorage) {
  const Scratch scratch;
  for (const auto type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT}) {
    write_parts(scratch.path("a.exr"), {spec_of(33, 21, {"R", "G", "B"}, type)});
    const Image image = read_channels(scratch.path("a.exr"), {"B", "R", "R"});
    for (int y = 0; y < 21; ++y)
      for (int x = 0; x < 33; ++x) {
        ASSERT_EQ(image.at(0, x, y), value_at(2, x, y));
        ASSERT_EQ(image.at(1, x, y), value_at(0, x, y));
        ASSERT_EQ(image.at(2, x, y), value_at(0, x, y));
      }
  }
}

TEST(ImageFile, FindsNamesWithSpacesAcrossWideGaps) {
  const Scratch scratch;
  std::vector<std::string> names;
  for (int i = 0; i < 40; ++i) names.push_back("ViewLayer.Pass " + std::to_string(100 + i) + ".X");
  write_parts(scratch.path("a.exr"), {spec_of(19, 40, names, OIIO::TypeDesc::FLOAT)});
  const Image image = read_channels(scratch.path("a.exr"), {names[30], names[2], names[4], names[39]});
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 19; ++x) {
      ASSERT_EQ(image.at(0, x, y), value_at(30, x, y));
      ASSERT_EQ(image.at(1, x, y), value_at(2, x, y));
      ASSERT_EQ(image.at(2, x, y), value_at(4, x, y));
      ASSERT_EQ(image.at(3, x, y), value_at(39, x, y));
    }
}

TEST(ImageFile, ReadsTiles) {
  const Scratch scratch;
  auto spec = spec_of(75, 50, {"R", "G", "B"});
  spec.tile_width = 32, spec.tile_height = 16;
  write_parts(scratch.path("a.exr"), {spec});
  const Image image = read_channels(scratch.path("a.exr"), {"G"});
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 75; ++x) ASSERT_EQ(image.at(0, x, y), value_at(1, x, y)) << x << ' ' << y;
}

// The data window may be inside, around, beside or across the display window.
TEST(ImageFile, HonoursBothWindows) {
  struct Case {
    int x, y, width, height;
  };
  for (const bool tiled : {false, true}) {
    for (const Case& data :
         {Case{2, 3, 5, 4}, {-3, -20, 40, 60}, {-4, -2, 10, 10}, {8, 9, 30, 30}, {50, 0, 5, 5}, {0, -9, 9, 5}}) {
      for (const auto& [left, top] : {std::pair(0, 0), {5, -7}}) {
        const Scratch scratch;
        auto spec = spec_of(data.width, data.height, {"R", "G", "B"});
        spec.x = data.x + left, spec.y = data.y + top;
        spec.full_x = left, spec.full_y = top, spec.full_width = 16, spec.full_height = 12;
        if (tiled) spec.tile_width = 16, spec.tile_height = 16;
        write_parts(scratch.path("a.exr"), {spec});
        ImageFile file(scratch.path("a.exr"));
        const Window covered = file.covered(1);
        const Image image = read_channels(scratch.path("a.exr"), {"G"});
        ASSERT_EQ(image.width(), 16);
        ASSERT_EQ(image.height(), 12);
        for (int y = 0; y < 12; ++y)
          for (int x = 0; x < 16; ++x) {
            const bool in = x >= data.x && x < data.x + data.width && y >= data.y && y < data.y + data.height;
            EXPECT_EQ(in, x >= covered.x0 && x < covered.x1 && y >= covered.y0 && y < covered.y1);
            ASSERT_EQ(image.at(0, x, y), in ? value_at(1, x + left, y + top) : -7.0f) << x << ' ' << y;
          }
      }
    }
  }
}

TEST(ImageFile, ReadsPartsByName) {
  const Scratch scratch;
  auto left = spec_of(9, 8, {"R", "G", "B"}), right = spec_of(9, 8, {"R", "depth.Z"}, OIIO::TypeDesc::FLOAT);
  left.attribute("oiio:subimagename", "left");
  right.attribute("oiio:subimagename", "right");
  write_parts(scratch.path("a.exr"), {left, right});
  EXPECT_EQ(ImageFile(scratch.path("a.exr")).channel_names(),
            (std::vector<std::string>{"left.R", "G", "B", "right.R", "depth.Z"}));
  const Image image = read_channels(scratch.path("a.exr"), {"right.R", "B", "depth.Z", "left.R"});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 9; ++x) {
      ASSERT_EQ(image.at(0, x, y), value_at(4, x, y));
      ASSERT_EQ(image.at(1, x, y), value_at(2, x, y));
      ASSERT_EQ(image.at(2, x, y), value_at(5, x, y));
      ASSERT_EQ(image.at(3, x, y), value_at(0, x, y));
    }
}

TEST(ImageFile, ReadsIdsOfEveryStorage) {
  const Scratch scratch;
  const auto write = [&](const std::string& name, OIIO::TypeDesc type, const void* pixels) {
    auto out = OIIO::ImageOutput::create(scratch.path(name));
    OIIO::ImageSpec spec(4, 1, 1, type);
    ASSERT_TRUE(out && out->open(scratch.path(name), spec) && out->write_image(type, pixels) && out->close());
  };
  const float floats[] = {0, 6, -1, std::numeric_limits<float>::quiet_NaN()};
  const std::uint32_t words[] = {0, 6, 4294967295u, 16777217u};
  const std::uint16_t shorts[] = {0, 6, 65535, 40001};
  const std::uint8_t bytes[] = {0, 6, 255, 128};
  write("f.exr", OIIO::TypeDesc::FLOAT, floats);
  write("u.exr", OIIO::TypeDesc::UINT32, words);
  write("s.png", OIIO::TypeDesc::UINT16, shorts);
  write("b.png", OIIO::TypeDesc::UINT8, bytes);
  const auto ids = [&](const std::string& name) {
    ImageFile file(scratch.path(name));
    const Image image = read_channels(scratch.path(name), {file.channel_names()[0]}, 0, true);
    return std::vector<std::uint32_t>(image.bits(0, 0), image.bits(0, 0) + 4);
  };
  EXPECT_EQ(ids("f.exr"), (std::vector<std::uint32_t>{0, 6, kNoId, kNoId}));
  EXPECT_EQ(ids("u.exr"), (std::vector<std::uint32_t>{0, 6, 4294967295u, 16777217u}));
  EXPECT_EQ(ids("s.png"), (std::vector<std::uint32_t>{0, 6, 65535, 40001}));
  EXPECT_EQ(ids("b.png"), (std::vector<std::uint32_t>{0, 6, 255, 128}));
}

TEST(ImageFile, NamesWhatIsWrong) {
  const Scratch scratch;
  EXPECT_EQ(failure(Exit::input, [&] { ImageFile(scratch.path("none.exr")); }),
            scratch.path("none.exr") + ": there is no such file");
  EXPECT_EQ(failure(Exit::input, [&] { ImageFile{scratch.folder()}; }),
            scratch.folder() + ": is a folder, not an image");
  std::ofstream(scratch.path("text.exr")) << "no image";
  EXPECT_TRUE(failure(Exit::input, [&] {
                ImageFile(scratch.path("text.exr"));
              }).starts_with(scratch.path("text.exr") + ": cannot be read: "));
}

TEST(ImageFile, RefusesTruncatedFilesOfEveryLength) {
  const Scratch scratch;
  const Image image = test::noise_image(40, 40, 3, 1);
  write_image(scratch.path("whole.exr"), image.view(), QUELL_RADIANCE);
  std::ifstream in(scratch.path("whole.exr"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (const std::size_t length :
       {std::size_t(0), std::size_t(3), std::size_t(100), std::size_t(300), bytes.size() / 2, bytes.size() - 1}) {
    std::ofstream(scratch.path("cut.exr"), std::ios::binary) << bytes.substr(0, length);
    const std::string text = failure(Exit::input, [&] { read_channels(scratch.path("cut.exr"), {"R", "G", "B"}); });
    EXPECT_TRUE(text.starts_with(scratch.path("cut.exr") + ": cannot be read: ")) << length << ": " << text;
    EXPECT_GT(text.size(), scratch.path("cut.exr").size() + 20) << text;
  }
}

TEST(ImageFile, RefusesHeadersThatAskForTooMuch) {
  const Scratch scratch;
  write_parts(scratch.path("a.exr"), {spec_of(4, 4, {"R", "G", "B"})});
  std::fstream file(scratch.path("a.exr"), std::ios::binary | std::ios::in | std::ios::out);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  for (const char* window : {"displayWindow"}) {
    const std::size_t at = bytes.find(window) + std::strlen(window) + 1 + 6 + 4;  // name, "box2i", size
    const std::int32_t box[4] = {0, 0, 299999, 9};
    std::memcpy(bytes.data() + at, box, sizeof box);
  }
  std::ofstream(scratch.path("b.exr"), std::ios::binary) << bytes;
  EXPECT_EQ(
      failure(Exit::input, [&] { ImageFile(scratch.path("b.exr")); }),
      scratch.path("b.exr") +
          ": a display window of 300000 x 10 pixels is not read; at most 131072 along a side and 268435456 in all are");
}

TEST(ImageFile, RefusesDeepImages) {
  const Scratch scratch;
  auto out = OIIO::ImageOutput::create("openexr");
  auto spec = spec_of(2, 2, {"R", "Z"}, OIIO::TypeDesc::FLOAT);
  spec.deep = true;
  ASSERT_TRUE(out->open(scratch.path("deep.exr"), spec)) << out->geterror();
  OIIO::DeepData deep(spec);
  ASSERT_TRUE(out->write_deep_image(deep)) << out->geterror();
  ASSERT_TRUE(out->close());
  EXPECT_EQ(failure(Exit::input, [&] { ImageFile(scratch.path("deep.exr")); }),
            scratch.path("deep.exr") + ": deep images are not read; flatten it first");
}

// Every conformance file either reads or is refused with its name; damaged ones may do either but never crash.
TEST(ImageFile, SurvivesTheConformanceImages) {
  const char* data = std::getenv("QUELL_TEST_DATA");
  if (!data) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  int read = 0, refused = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(data) / "openexr-images")) {
    const std::string path = entry.path().string();
    const bool damaged = path.find("/Damaged/") != path.npos;
    if (!entry.is_regular_file() || (!damaged && !path.ends_with(".exr"))) continue;
    try {
      ImageFile file(path);
      std::vector<float> row;
      for (std::size_t c = 0; c < file.channels().size() && c < 8; ++c) {
        const auto size = file.size(int(c));
        if (std::int64_t(size.width) * size.height > 1 << 24) continue;
        Image image(size.width, size.height, 1);
        const ChannelRead one{int(c), image.row(0, 0)};
        file.read({&one, 1}, image.pitch());
      }
      ++read;
    } catch (const Error& e) {
      ++refused;
      EXPECT_EQ(e.exit(), Exit::input) << path;
      EXPECT_TRUE(std::string(e.what()).starts_with(path + ": ")) << e.what();
    }
  }
  EXPECT_GT(read, 10);
  EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace quell::test
