// Encodes images in memory, where nothing can half fail, and hands the bytes to a temporary file.
#include "core/sequence/image_writer.h"

#include "core/report/error.h"
#include "core/report/suggest.h"
#include "core/sequence/temporary_file.h"

#include <quell/types.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>

namespace quell {

namespace {

namespace oiio = OIIO;

constexpr float kLargestHalf = 65504.0f;
// A multiple of the rows that every compression packs together.
constexpr int kStrip = 64;

const std::array<std::string, 8> kCompressions = {"none", "rle", "zips", "zip", "piz", "pxr24", "dwaa", "dwab"};

bool half_holds(int type) {
  switch (type) {
    case QUELL_RADIANCE:
    case QUELL_ALBEDO:
    case QUELL_NORMAL:
    case QUELL_MOTION:
    case QUELL_DISPLAY:
    case QUELL_FEATURES:
      return true;
    default:
      return false;
  }
}

float srgb_from_linear(float v) {  // IEC 61966-2-1
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

std::uint8_t to_byte(float v) {
  return std::uint8_t(std::lround(255.0f * std::clamp(std::isnan(v) ? 0.0f : v, 0.0f, 1.0f)));
}

// The whole encoded file.
class Encoder {
 public:
  Encoder(const std::string& path, const char* format) : path_(path), output_(oiio::ImageOutput::create(format)) {
    if (!output_) fail(oiio::geterror());
  }
  ~Encoder() {
    output_.reset();  // before the bytes that it writes to
  }
  void open(oiio::ImageSpec spec) {
    spec.attribute("DateTime",
                   "");  // the time of writing, which OpenImageIO adds, would make equal images unequal files
    output_->set_ioproxy(&bytes_);
    if (!output_->open(path_, spec)) fail(output_->geterror());
  }
  void rows(int begin, int end, oiio::TypeDesc type, const void* data) {
    if (!output_->write_scanlines(begin, end, 0, type, data)) fail(output_->geterror());
  }
  const std::vector<unsigned char>& finish() {
    if (!output_->close()) fail(output_->geterror());
    return bytes_.buffer();
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(Exit::resources, fmt::format("cannot write '{}': {}", path_, why));
  }
  std::string path_;
  oiio::Filesystem::IOVecOutput bytes_;
  std::unique_ptr<oiio::ImageOutput> output_;
};

// Numbers of a strip, pixel by pixel. Words keep their bits, for some are no floats.
void interleave(const quell_image& image, int top, int bottom, bool half, std::vector<std::uint32_t>& strip) {
  const auto channels = std::size_t(image.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    std::uint32_t* to = strip.data() + c;
    for (int y = top; y < bottom; ++y) {
      const float* row = image.plane[c] + y * image.pitch;
      for (int x = 0; x < image.width; ++x, to += channels)
        *to = std::bit_cast<std::uint32_t>(half ? std::clamp(row[x], -kLargestHalf, kLargestHalf) : row[x]);
    }
  }
}

void write_exr(Encoder& encoder, const quell_image& image, int type, const WriteOptions& options) {
  const bool half = options.half && half_holds(type);
  oiio::ImageSpec spec(image.width, image.height, image.channels, half ? oiio::TypeDesc::HALF : oiio::TypeDesc::FLOAT);
  spec.channelnames = channel_names(type, image.channels);
  spec.attribute("compression", options.compression);
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [key, value] : options.metadata) spec.attribute(key, value);
  if (type == QUELL_ID) {
    spec.set_format(oiio::TypeDesc::UINT32);
  } else if (type == QUELL_TAPS) {
    spec.channelformats.assign(std::size_t(image.channels), oiio::TypeDesc::FLOAT);
    spec.channelformats.back() = oiio::TypeDesc::UINT32;
  }
  encoder.open(spec);
  std::vector<std::uint32_t> strip(std::size_t(kStrip) * std::size_t(image.width) * std::size_t(image.channels));
  for (int top = 0; top < image.height; top += kStrip) {
    const int bottom = std::min(top + kStrip, image.height);
    interleave(image, top, bottom, half, strip);
    // UNKNOWN: as the file has them.
    encoder.rows(top, bottom, half ? oiio::TypeDesc::FLOAT : oiio::TypeDesc::UNKNOWN, strip.data());
  }
}

void write_png(Encoder& encoder, const quell_image& image, int type, const WriteOptions& options) {
  oiio::ImageSpec spec(image.width, image.height, image.channels, oiio::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  for (const auto& [key, value] : options.metadata) spec.attribute(key, value);
  encoder.open(spec);
  std::vector<std::uint8_t> row(std::size_t(image.width) * std::size_t(image.channels));
  for (int y = 0; y < image.height; ++y) {
    for (int c = 0; c < image.channels; ++c) {
      const float* from = image.plane[c] + y * image.pitch;
      std::uint8_t* to = row.data() + c;
      for (int x = 0; x < image.width; ++x, to += image.channels) {
        const float v = from[x];
        *to = to_byte(type == QUELL_DISPLAY  ? v
                      : type == QUELL_NORMAL ? 0.5f + 0.5f * v
                                             : srgb_from_linear(std::clamp(v, 0.0f, 1.0f)));
      }
    }
    encoder.rows(y, y + 1, oiio::TypeDesc::UINT8, row.data());
  }
}

}  // namespace

std::span<const std::string> compressions() { return kCompressions; }

std::vector<std::string> channel_names(int type, int channels) {
  switch (type) {
    case QUELL_RADIANCE:
    case QUELL_ALBEDO:
    case QUELL_DISPLAY:
      return {"R", "G", "B"};
    case QUELL_NORMAL:
    case QUELL_POSITION:
      return {"X", "Y", "Z"};
    case QUELL_MOTION:
    case QUELL_SLOPE:
    case QUELL_MOMENTS:
      return {"X", "Y"};
    case QUELL_DEPTH:
      return {"Z"};
    case QUELL_TAPS:
      return {"NW", "NE", "SW", "SE", "mask"};
    default:
      break;
  }
  if (channels == 1) return {"Y"};
  // EXR orders channels by name, so numbers need zeros in front.
  std::vector<std::string> names;
  for (int c = 0; c < channels; ++c) names.push_back(fmt::format("F{:04}", c));
  return names;
}

void check_writing(const std::string& path, int type, const WriteOptions& options) {
  const bool exr = path.ends_with(".exr"), png = path.ends_with(".png");
  if (!exr && !png) throw Error(Exit::usage, fmt::format("cannot write '{}': the name must end in .exr or .png", path));
  if (png && type != QUELL_RADIANCE && type != QUELL_ALBEDO && type != QUELL_DISPLAY && type != QUELL_NORMAL) {
    throw Error(Exit::usage,
                fmt::format("cannot write '{}': PNG shows radiance, albedo, display and normal, not {}; write .exr",
                            path, type_name(type)));
  }
  if (std::ranges::find(kCompressions, options.compression) == kCompressions.end()) {
    throw Error(Exit::usage, fmt::format("no compression is called '{}'; {}", options.compression,
                                         possibilities("there are", options.compression, kCompressions)));
  }
}

void write_image(const std::string& path, const quell_image& image, int type, const WriteOptions& options) {
  check_writing(path, type, options);
  const bool exr = path.ends_with(".exr");
  try {
    Encoder encoder(path, exr ? "openexr" : "png");
    if (exr) {
      write_exr(encoder, image, type, options);
    } else {
      write_png(encoder, image, type, options);
    }
    const auto& bytes = encoder.finish();
    TemporaryFile file(path);
    file.write(bytes.data(), bytes.size());
    file.commit();
  } catch (const std::bad_alloc&) {
    throw Error(Exit::resources, fmt::format("cannot write '{}': there is not enough memory", path));
  }
}

}  // namespace quell
