// Colours of files become linear light by what the file states; nothing else in a file is touched by it.
#include "core/sequence/color_encoding.h"

#include "core/image/image.h"
#include "core/report/error.h"
#include "core/sequence/pictures.h"
#include "core/sequence/sequence.h"
#include "tests/support/failure.h"
#include "tests/support/read_role.h"
#include "tests/support/scratch.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <numeric>

namespace quell {
namespace {

using Curve = ColorEncoding::Curve;
using OIIO::TypeDesc;

// The curves in double precision; `p` only matters to a power.
double srgb(double v, double) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double rec709(double v, double) { return v < 0.081 ? v / 4.5 : std::pow((v + 0.099) / 1.099, 1 / 0.45); }
double power(double v, double p) { return std::pow(v, p); }

class ColorsOfFiles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.path(name); }

  // One row of pixels; `numbers` of all channels, interleaved.
  template <class Number>
  void write(const std::string& name, int channels, const std::vector<Number>& numbers, OIIO::ParamValueList stated) {
    const TypeDesc type = TypeDesc(OIIO::BaseTypeFromC<Number>::value);
    OIIO::ImageSpec spec(int(numbers.size()) / channels, 1, channels, type);
    for (const auto& s : stated) spec.extra_attribs.add_or_replace(s);
    auto out = OIIO::ImageOutput::create(path(name));
    ASSERT_TRUE(out && out->open(path(name), spec) && out->write_image(type, numbers.data()) && out->close())
        << name << ": " << (out ? out->geterror() : OIIO::geterror());
  }

  Image read(const std::string& name, const std::string& role = "color", int type = QUELL_RADIANCE,
             const Conversion& conversion = {}) {
    Sequence sequence = pictures(path(name), {});
    sequence.inputs[0].role = role, sequence.inputs[0].type = type;
    sequence.inputs[0].choices[0].conversion = conversion;
    const auto source = open_sequence(sequence, {}, Missing::error, diagnostics_);
    if (!source) throw std::runtime_error(diagnostics_.format());
    return test::read_role(*source, 0, role);
  }

  // Every number of `numbers`, red and blue the other way round, reads as the formula has it.
  template <class Number>
  void expect_decoded(const std::string& name, OIIO::ParamValueList stated, double (*formula)(double, double),
                      double parameter = 1) {
    const double most = std::is_integral_v<Number> ? double(std::numeric_limits<Number>::max()) : 1.0;
    std::vector<Number> ramp(511), pixels;
    for (std::size_t i = 0; i < ramp.size(); ++i)
      ramp[i] = Number(std::is_integral_v<Number> ? std::round(double(i) / 510 * most) : double(i) / 128);
    for (std::size_t i = 0; i < ramp.size(); ++i)
      pixels.insert(pixels.end(), {ramp[i], ramp[i / 2], ramp[ramp.size() - 1 - i]});
    write(name, 3, pixels, std::move(stated));
    const Image image = read(name);
    ASSERT_EQ(image.width(), int(ramp.size()));
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        const double light = formula(double(pixels[std::size_t(3 * x + c)]) / most, parameter);
        // A float's rounding (6e-8) of v and of the exponent p, which pow raises to p and to ln v, at most 11.
        ASSERT_NEAR(image.at(c, x, 0), light, 2e-6 * light) << name << ' ' << x << ' ' << c;
      }
  }

  static OIIO::ParamValueList space(const char* name, float gamma = 0) {
    OIIO::ParamValueList list;
    list.attribute("oiio:ColorSpace", name);
    if (gamma > 0) list.attribute("oiio:Gamma", gamma);
    return list;
  }

  const test::Scratch scratch_;
  Diagnostics diagnostics_;
};

TEST_F(ColorsOfFiles, AreWhatTheFileStates) {
  expect_decoded<std::uint8_t>("none.png", {}, srgb);
  expect_decoded<std::uint8_t>("srgb.png", space("sRGB"), srgb);
  expect_decoded<std::uint16_t>("words.png", space("sRGB"), srgb);
  // 1/2.2 without the mark of sRGB, as ImageMagick writes it.
  expect_decoded<std::uint8_t>("imagemagick.png", space("Gamma2.2", 2.2f), srgb);
  expect_decoded<std::uint8_t>("mac.png", space("Gamma1.8", 1.8f), power, 1.8);
  expect_decoded<std::uint16_t>("odd.png", space("Gamma2.35", 2.35f), power, 2.35);
  expect_decoded<std::uint8_t>("mac.tga", space("Gamma1.8", 1.8f), power, 1.8);
  expect_decoded<std::uint16_t>("linear.png", space("linear"), power);
}

TEST_F(ColorsOfFiles, WholeNumbersAreSrgbAndFloatsAreLinear) {
  for (const char* name : {"a.tif", "a.bmp", "a.tga", "a.ppm", "a.sgi"}) expect_decoded<std::uint8_t>(name, {}, srgb);
  expect_decoded<std::uint16_t>("words.tif", {}, srgb);
  expect_decoded<float>("floats.tif", {}, power);
  expect_decoded<float>("floats.exr", {}, power);
}

TEST_F(ColorsOfFiles, RadianceFilesAreWhatTheyState) {
  // Their 8 bits of mantissa hold these.
  std::vector<float> gray;
  for (int i = 128; i < 256; ++i) gray.insert(gray.end(), 3, float(i) / 256);
  write("a.hdr", 3, gray, {});
  std::ifstream in(path("a.hdr"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto line = bytes.find('\n') + 1;
  const auto expect = [&](const std::string& stated, double (*formula)(double, double), double parameter) {
    std::ofstream(path("b.hdr"), std::ios::binary) << bytes.substr(0, line) << stated << bytes.substr(line);
    const Image image = read("b.hdr");
    for (int x = 0; x < 128; ++x)
      ASSERT_NEAR(image.at(1, x, 0), formula(gray[std::size_t(3 * x)], parameter), 6e-7) << stated << ' ' << x;
  };
  expect("", power, 1);
  expect("GAMMA=1\n", power, 1);
  expect("GAMMA=0.45455\n", srgb, 1);  // as ImageMagick writes it
  expect("GAMMA=0.5\n", power, 2);
}

TEST_F(ColorsOfFiles, FilmIsDecodedOrRefused) {
  expect_decoded<std::uint16_t>("video.dpx", space("Rec709"), rec709);
  write("film.dpx", 3, std::vector<std::uint16_t>{1, 2, 3}, space("KodakLog"));
  EXPECT_EQ(test::failure(Exit::input, [&] { read("film.dpx"); }),
            "frame 0: " + path("film.dpx") +
                ": its colours are encoded as 'KodakLog', which is not decoded\n  convert it to linear OpenEXR, or to "
                "sRGB");
}

TEST_F(ColorsOfFiles, EncodingsByStatement) {
  const auto curve = [](const char* stated, double gamma, bool whole) {
    return color_encoding(stated, gamma, whole).curve;
  };
  EXPECT_EQ(curve("Linear", 0, true), Curve::linear);
  EXPECT_EQ(curve("", 1, true), Curve::linear);
  EXPECT_EQ(curve("Gamma2.2", 0, true), Curve::unknown);  // a name is no number
  EXPECT_EQ(curve("sRGB", 0, false), Curve::linear);
  EXPECT_EQ(color_encoding("", 2.21, true), (ColorEncoding{Curve::power, 2.21, ""}));
  // Repairs of negative radiance come after it, and count.
  EXPECT_FLOAT_EQ(linear_light({Curve::power, 2, ""}, -3), -9);
  EXPECT_FLOAT_EQ(linear_light({Curve::srgb, 1, ""}, -12.92f), -1);
}

// What is no colour is what the file holds.
TEST_F(ColorsOfFiles, FeaturesAreNotDecoded) {
  const std::vector<std::uint8_t> pixel = {128, 200, 230};
  for (const char* name : {"f.tif", "f.png"}) {
    write(name, 3, pixel, space("sRGB"));
    Conversion encoded;
    encoded.encoded = true;
    const Image normal = read(name, "normal", QUELL_NORMAL, encoded), albedo = read(name, "albedo", QUELL_ALBEDO),
                display = read(name, "display", QUELL_DISPLAY);
    double v[3], squares = 0;
    for (std::size_t c = 0; c < 3; ++c) v[c] = pixel[c] / 127.5 - 1, squares += v[c] * v[c];
    for (int c = 0; c < 3; ++c) {
      const double stored = pixel[std::size_t(c)] / 255.0;
      EXPECT_NEAR(normal.at(c, 0, 0), v[c] / std::sqrt(squares), 1e-6) << name;
      EXPECT_NEAR(albedo.at(c, 0, 0), srgb(stored, 1), 1e-6) << name;
      EXPECT_NEAR(display.at(c, 0, 0), stored, 1e-7) << name;
    }
  }
}

// Transparent pixels keep their colours, normals and ids.
TEST_F(ColorsOfFiles, AlphaIsNotRead) {
  const std::vector<std::uint8_t> pixels = {200, 100, 50, 64, 10, 20, 30, 0};
  OIIO::ParamValueList straight;
  straight.attribute("oiio:UnassociatedAlpha", 1);
  for (const char* name : {"a.png", "a.tif", "a.tga"}) {
    write(name, 4, pixels, straight);
    const Image color = read(name), id = read(name, "id", QUELL_ID);
    for (int x = 0; x < 2; ++x) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(color.at(c, x, 0), srgb(pixels[std::size_t(4 * x + c)] / 255.0, 1), 1e-6) << name;
      EXPECT_EQ(id.bits(0, 0)[x], pixels[std::size_t(4 * x)]) << name;
    }
  }
}

TEST_F(ColorsOfFiles, GrayIsReadAsThreeEqualColors) {
  std::vector<std::uint8_t> gray(256), with_alpha;
  std::iota(gray.begin(), gray.end(), std::uint8_t(0));
  for (const auto g : gray) with_alpha.insert(with_alpha.end(), {g, 128});
  write("g.png", 1, gray, {});
  write("g.tif", 1, gray, {});
  OIIO::ParamValueList straight;
  straight.attribute("oiio:UnassociatedAlpha", 1);
  write("ga.png", 2, with_alpha, straight);
  for (const char* name : {"g.png", "g.tif", "ga.png"})
    for (const auto& [role, type] : {std::pair("color", QUELL_RADIANCE), {"albedo", QUELL_ALBEDO}}) {
      const Image image = read(name, role, type);
      ASSERT_EQ(image.channels(), 3) << name;
      for (int x = 0; x < 256; ++x)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.at(c, x, 0), srgb(x / 255.0, 1), 1e-6) << name << ' ' << x;
    }
}

TEST_F(ColorsOfFiles, AnAxisIsNoGray) {
  OIIO::ImageSpec spec(1, 1, 3, TypeDesc::FLOAT);
  spec.channelnames = {"X", "Y", "Z"};
  const float pixel[] = {1, 2, 3};
  auto out = OIIO::ImageOutput::create("openexr");
  ASSERT_TRUE(out->open(path("n.exr"), spec) && out->write_image(TypeDesc::FLOAT, pixel) && out->close());
  const std::string text = test::failure([&] { read("n.exr"); });
  EXPECT_NE(text.find("usual names: R G B, r g b, Y alone\n  it has: X, Y, Z\n  name them in a sequence file, with "
                      "\"channels\""),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace quell
