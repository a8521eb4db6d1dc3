// Encodes images in memory, where nothing can half fail, and hands the bytes to a temporary file.
#include "core/sequence/image_writer.h"

#include "core/report/error.h"
#include "core/sequence/exr_writer.h"
#include "core/sequence/image_formats.h"
#include "core/sequence/pieces.h"
#include "core/sequence/temporary_file.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <new>

namespace quell {

namespace {

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

std::vector<char> exr_bytes(const quell_image& image, int type, const WriteOptions& options) {
  using Storage = ExrChannel::Storage;
  const auto storage = type == QUELL_ID                   ? Storage::integer
                       : options.half && half_holds(type) ? Storage::half
                                                          : Storage::floating;
  std::vector<ExrChannel> channels;
  for (const auto& name : channel_names(type, image.channels)) channels.push_back({name, storage});
  if (type == QUELL_TAPS) channels.back().storage = Storage::integer;
  return encode_exr(image, channels, options.compression, options.metadata);
}

std::vector<unsigned char> png_bytes(const quell_image& image, int type, const WriteOptions& options) {
  std::vector<std::uint8_t> pixels(std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels));
  in_pieces(image.height, [&](int y) {
    for (int c = 0; c < image.channels; ++c) {
      const float* from = image.plane[c] + y * image.pitch;
      std::uint8_t* to = pixels.data() + std::size_t(y) * std::size_t(image.width) * std::size_t(image.channels) + c;
      for (int x = 0; x < image.width; ++x, to += image.channels) {
        const float v = from[x];
        *to = to_byte(type == QUELL_DISPLAY  ? v
                      : type == QUELL_NORMAL ? 0.5f + 0.5f * v
                                             : srgb_from_linear(std::clamp(v, 0.0f, 1.0f)));
      }
    }
  });
  return image_formats().encode_png(image.width, image.height, image.channels, pixels, options.metadata);
}

template <class Bytes>
void write_file(const std::string& path, const Bytes& bytes) {
  TemporaryFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace

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

void check_writing(const std::string& path, int type) {
  const bool exr = path.ends_with(".exr"), png = path.ends_with(".png");
  if (!exr && !png) throw Error(Exit::usage, fmt::format("cannot write '{}': the name must end in .exr or .png", path));
  if (png && type != QUELL_RADIANCE && type != QUELL_ALBEDO && type != QUELL_DISPLAY && type != QUELL_NORMAL) {
    throw Error(Exit::usage,
                fmt::format("cannot write '{}': PNG shows radiance, albedo, display and normal, not {}; write .exr",
                            path, type_name(type)));
  }
}

void write_image(const std::string& path, const quell_image& image, int type, const WriteOptions& options) {
  check_writing(path, type);
  try {
    if (path.ends_with(".exr")) {
      write_file(path, exr_bytes(image, type, options));
    } else {
      write_file(path, png_bytes(image, type, options));
    }
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(Exit::resources, fmt::format("cannot write '{}': there is not enough memory", path));
  } catch (const std::exception& e) {
    throw Error(Exit::resources, fmt::format("cannot write '{}': {}", path, e.what()));
  }
}

}  // namespace quell
