// The bytes of OpenEXR files: conversions on every SIMD target, and blocks that others packed.
#include "core/image/image.h"
#include "core/report/error.h"
#include "core/sequence/exr_block.h"
#include "core/sequence/exr_kernels.h"
#include "core/sequence/exr_writer.h"
#include "core/sequence/image_file.h"
#include "core/sequence/image_writer.h"
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

namespace quell {
namespace {

using test::Scratch;

// IEEE 754 binary16, by its definition.
double value_of_half(std::uint16_t h) {
  const int exponent = (h >> 10) & 31, fraction = h & 1023;
  const double sign = h & 0x8000 ? -1 : 1;
  if (exponent == 31) return fraction ? std::nan("") : sign * HUGE_VAL;
  return sign * (exponent ? std::ldexp(1024 + fraction, exponent - 25) : std::ldexp(fraction, -24));
}

std::vector<std::uint8_t> random_bytes(std::size_t n) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> bytes(n);
  for (auto& b : bytes) b = std::uint8_t(random());
  return bytes;
}

TEST(ExrKernels, EveryHalfIsItsValue) {
  std::vector<std::uint8_t> halves, low, high;
  for (int i = 0; i < 65536; ++i) {
    low.push_back(std::uint8_t(i)), high.push_back(std::uint8_t(i >> 8));
    halves.push_back(low.back()), halves.push_back(high.back());
  }
  test::for_each_target([&] {
    std::vector<float> whole(65536), split(65536);
    halves_to_floats(halves.data(), whole.data(), whole.size());
    halves_to_floats(low.data(), high.data(), split.data(), split.size());
    for (int i = 0; i < 65536; ++i) {
      const double expected = value_of_half(std::uint16_t(i));
      ASSERT_EQ(std::isnan(whole[std::size_t(i)]), std::isnan(expected)) << i;
      if (!std::isnan(expected)) {
        ASSERT_EQ(double(whole[std::size_t(i)]), expected) << i;
      }
      ASSERT_EQ(std::bit_cast<std::uint32_t>(whole[std::size_t(i)]),
                std::bit_cast<std::uint32_t>(split[std::size_t(i)]))
          << i;
    }
  });
}

// Each half, the middle between it and the next, and the floats to both sides of the middle.
TEST(ExrKernels, EveryFloatBecomesTheNearestHalf) {
  std::vector<float> floats;
  std::vector<int> expected;
  for (int h = 0; h < 0x7C00; ++h) {
    const auto here = float(value_of_half(std::uint16_t(h)));
    floats.push_back(here), expected.push_back(h);
    if (h == 0x7BFF) break;
    const auto middle = float((double(here) + value_of_half(std::uint16_t(h + 1))) / 2);
    floats.push_back(std::nextafter(middle, 0.0f)), expected.push_back(h);
    floats.push_back(middle), expected.push_back(h + (h & 1));
    floats.push_back(std::nextafter(middle, 1e9f)), expected.push_back(h + 1);
  }
  for (const float beyond : {65505.0f, 65520.0f, 1e30f, HUGE_VALF})
    floats.push_back(beyond), expected.push_back(0x7BFF);
  const std::size_t positive = floats.size();
  for (std::size_t i = 0; i < positive; ++i) floats.push_back(-floats[i]), expected.push_back(expected[i] | 0x8000);
  test::for_each_target([&] {
    std::vector<std::uint16_t> whole(floats.size());
    std::vector<std::uint8_t> low(floats.size()), high(floats.size());
    floats_to_halves(floats.data(), whole.data(), floats.size());
    floats_to_halves(floats.data(), low.data(), high.data(), floats.size());
    for (std::size_t i = 0; i < floats.size(); ++i) {
      ASSERT_EQ(whole[i], expected[i]) << floats[i];
      ASSERT_EQ(low[i] | high[i] << 8, expected[i]) << floats[i];
    }
    const float none = std::nanf("");
    floats_to_halves(&none, whole.data(), 1);
    EXPECT_TRUE(std::isnan(value_of_half(whole[0])));
  });
}

TEST(ExrKernels, BytesComeBackForEveryLength) {
  test::for_each_target([] {
    for (std::size_t n = 0; n <= 70; ++n) {
      const auto bytes = random_bytes(2 * n);
      std::vector<std::uint8_t> differences(2 * n), even(n), odd(n), joined(2 * n);
      take_differences(bytes.data(), differences.data(), 2 * n);
      for (std::size_t i = 1; i < 2 * n; ++i) ASSERT_EQ(differences[i], std::uint8_t(bytes[i] - bytes[i - 1] + 128));
      sum_differences(differences.data(), 2 * n);
      ASSERT_EQ(differences, bytes) << n;
      split_bytes(bytes.data(), even.data(), odd.data(), n);
      for (std::size_t i = 0; i < n; ++i) ASSERT_TRUE(even[i] == bytes[2 * i] && odd[i] == bytes[2 * i + 1]);
      join_bytes(even.data(), odd.data(), joined.data(), n);
      ASSERT_EQ(joined, bytes) << n;
    }
  });
}

TEST(ExrCompression, IsReadFromText) {
  EXPECT_EQ(parse_exr_compression("zip")->name, "zip");
  EXPECT_FALSE(parse_exr_compression("zip")->level);
  EXPECT_EQ(parse_exr_compression("zips:9")->level, 9);
  EXPECT_EQ(parse_exr_compression("dwab:0")->level, 0);
  for (const char* wrong :
       {"", "zop", "zip:", "zip:0", "zip:13", "zip:9x", "zip:-1", "piz:3", "none:1", ":4", "dwaa:1e3"})
    EXPECT_FALSE(parse_exr_compression(wrong)) << wrong;
}

// What OpenImageIO, which packs and unpacks by OpenEXR, makes of our files, and we of its.
class ExrFiles : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  static std::vector<float> by_oiio(const std::string& path) {
    const auto in = OIIO::ImageInput::open(path);
    if (!in) throw std::runtime_error(OIIO::geterror());
    const auto& spec = in->spec();
    EXPECT_EQ(spec.get_string_attribute("compression"), std::get<0>(GetParam()));
    std::vector<float> pixels(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
    EXPECT_TRUE(in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data())) << in->geterror();
    return pixels;
  }
  static std::vector<float> by_us(const std::string& path) {
    ImageFile file(path);
    const auto size = file.size(0);
    const std::size_t plane = std::size_t(size.width) * std::size_t(size.height), n = file.channels().size();
    std::vector<float> planes(plane * n), pixels(plane * n);
    std::vector<ChannelRead> reads;
    for (std::size_t c = 0; c < n; ++c) reads.push_back({int(c), planes.data() + c * plane});
    file.read(reads, size.width);
    for (std::size_t i = 0; i < plane; ++i)
      for (std::size_t c = 0; c < n; ++c) pixels[i * n + c] = planes[c * plane + i];
    return pixels;
  }
};

TEST_P(ExrFiles, ReadAlikeEverywhere) {
  const auto& [compression, half] = GetParam();
  const Scratch scratch;
  for (const auto& [width, height] : {std::pair(1, 1), {17, 3}, {1, 70}, {130, 67}, {64, 300}}) {
    for (const bool smooth : {false, true}) {  // noise does not deflate, and is stored as it is
      Image image = test::noise_image(width, height, 3, 1, -2.0f, 10.0f);
      if (smooth)
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) image.at(1, x, y) = image.at(0, x, y) = float(x + y) / 16;
      write_image(scratch.path("ours.exr"), image.view(), QUELL_RADIANCE, {half, {compression, {}}, {}});
      const auto theirs_of_ours = by_oiio(scratch.path("ours.exr"));
      ASSERT_EQ(theirs_of_ours, by_us(scratch.path("ours.exr"))) << width << " x " << height;
      for (std::size_t i = 0; i < theirs_of_ours.size() && compression[0] != 'b' && compression[0] != 'd'; ++i) {
        const float v = image.at(int(i % 3), int(i / 3) % width, int(i / 3) / width);
        ASSERT_NEAR(theirs_of_ours[i], v, half ? std::abs(v) / 2048 : compression == "pxr24" ? std::abs(v) / 32768 : 0);
      }

      OIIO::ImageSpec spec(width, height, 3, half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
      spec.attribute("compression", compression);
      const auto out = OIIO::ImageOutput::create("openexr");
      ASSERT_TRUE(out->open(scratch.path("theirs.exr"), spec) &&
                  out->write_image(OIIO::TypeDesc::FLOAT, theirs_of_ours.data()) && out->close());
      ASSERT_EQ(by_oiio(scratch.path("theirs.exr")), by_us(scratch.path("theirs.exr"))) << width << " x " << height;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Compressions, ExrFiles,
                         testing::Combine(testing::ValuesIn(exr_compressions().begin(), exr_compressions().end()),
                                          testing::Bool()),
                         [](const auto& i) {
                           return std::get<0>(i.param) + (std::get<1>(i.param) ? "Half" : "Float");
                         });

TEST(ExrWriter, ALevelTradesTimeForSize) {
  const Scratch scratch;
  Image image = test::noise_image(256, 256, 3, 1);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) image.at(0, x, y) = image.at(1, x, y) = std::sin(float(x) / 9) + float(y) / 8;
  const auto size = [&](const char* compression) {
    write_image(scratch.path("a.exr"), image.view(), QUELL_RADIANCE, {true, *parse_exr_compression(compression), {}});
    return std::filesystem::file_size(scratch.path("a.exr"));
  };
  EXPECT_LT(size("zip:9"), size("zip:1"));
  EXPECT_LT(size("dwaa:500"), size("dwaa:10"));
}

// A block's bytes in a file that was whole: every one of them flipped is an error or another image, and never a crash.
TEST(ExrReader, SurvivesEveryFlippedByte) {
  const Scratch scratch;
  Image image = test::constant_image(9, 20, 3, 0.5f);
  for (int x = 0; x < 9; ++x) image.at(1, x, 3) = float(x);
  for (const char* compression : {"none", "zip", "zips"}) {
    write_image(scratch.path("a.exr"), image.view(), QUELL_RADIANCE, {true, {compression, {}}, {}});
    std::ifstream in(scratch.path("a.exr"), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    int refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at)
      for (const char flip : {'\x01', '\x80'}) {
        std::string bytes = whole;
        bytes[at] = char(bytes[at] ^ flip);
        std::ofstream(scratch.path("b.exr"), std::ios::binary) << bytes;
        try {
          ImageFile file(scratch.path("b.exr"));
          const auto size = file.size(0);
          if (std::int64_t(size.width) * size.height > 1 << 22) continue;
          Image plane(size.width, size.height, 1);
          for (std::size_t c = 0; c < file.channels().size(); ++c) {
            const ChannelRead one{int(c), plane.row(0, 0)};
            file.read({&one, 1}, plane.pitch());
          }
        } catch (const Error& e) {
          ++refused;
          ASSERT_EQ(e.exit(), Exit::input);
          ASSERT_TRUE(std::string(e.what()).starts_with(scratch.path("b.exr") + ": ")) << e.what();
        }
      }
    EXPECT_GT(refused, 100) << compression;
  }
}

}  // namespace
}  // namespace quell
