// Reads headers and pixels through OpenImageIO, in strips, and no channel that nobody asked for unless it lies between
// two.
#include "core/sequence/image_file.h"

#include "core/report/error.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <new>

namespace quell {

namespace {

namespace oiio = OIIO;

constexpr std::int64_t kMostPixels = std::int64_t(1) << 28;
constexpr std::int64_t kLongestSide = std::int64_t(1) << 17;
constexpr std::int64_t kFarthestCorner = std::int64_t(1) << 24;  // so that sums of coordinates stay in range
// OpenEXR unpacks a whole tile, with all its channels, however small the image is.
constexpr std::int64_t kMostTileBytes = std::int64_t(1) << 28;
constexpr int kMostChannels = 1024;
constexpr int kMostParts = 256;
// Unwanted channels between two wanted ones that cost less to read than a second call.
constexpr int kGap = 4;

// Rows that the file's compression packs together: strips of as many decompress each block once.
int rows_per_block(std::string_view compression) {
  if (compression.starts_with("dwab")) return 256;
  for (const char* name : {"piz", "b44", "dwaa"})
    if (compression.starts_with(name)) return 32;
  return 16;
}

FileChannel::Storage storage_of(oiio::TypeDesc type) {
  switch (type.basetype) {
    case oiio::TypeDesc::UINT8:
      return FileChannel::Storage::byte;
    case oiio::TypeDesc::UINT16:
      return FileChannel::Storage::word;
    case oiio::TypeDesc::UINT32:
      return FileChannel::Storage::integer;
    case oiio::TypeDesc::HALF:
    case oiio::TypeDesc::FLOAT:
    case oiio::TypeDesc::DOUBLE:
      return FileChannel::Storage::floating;
    default:
      return FileChannel::Storage::other;
  }
}

std::uint32_t to_id(float value) {
  // The largest float below 2^32; NaN fails both comparisons.
  return value >= 0.0f && value <= 4294967040.0f ? std::uint32_t(value) : kNoId;
}

}  // namespace

void quiet_image_threads() {
  oiio::attribute("threads", 1);
  oiio::attribute("exr_threads", -1);
}

Window intersection(const Window& a, const Window& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

struct ImageFile::Part {
  std::string name;
  int width = 0, height = 0;  // of the display window
  int left = 0, top = 0;      // of the display window, in the file's coordinates
  int x = 0, y = 0, z = 0;    // of the data window, in the file's coordinates
  int data_width = 0, data_height = 0;
  int tile_height = 0;  // 0: scan lines
  int block_rows = 16;
  int channels = 0;
  bool display_encoded = false;
};

class ImageFile::Reader {
 public:
  std::unique_ptr<oiio::ImageInput> input;
};

ImageFile::ImageFile(ImageFile&&) noexcept = default;
ImageFile::~ImageFile() = default;

void ImageFile::refuse(const std::string& why) const { throw Error(Exit::input, fmt::format("{}: {}", path_, why)); }

ImageFile::ImageFile(std::string path) : path_(std::move(path)), reader_(std::make_unique<Reader>()) {
  std::error_code error;
  const auto status = std::filesystem::status(path_, error);
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  if (std::filesystem::is_directory(status)) refuse("is a folder, not an image");
  // Any exception of a codec is a damaged file, and so is an allocation that only a damaged header asks for.
  try {
    auto& input = reader_->input;
    input = oiio::ImageInput::open(path_);
    if (!input) refuse(fmt::format("cannot be read: {}", oiio::geterror()));
    for (int part = 0; part < kMostParts && (part == 0 || input->seek_subimage(part, 0)); ++part) {
      const oiio::ImageSpec& spec = input->spec();
      const std::string where = part ? fmt::format("part {}: ", part) : "";
      if (spec.deep) refuse(where + "deep images are not read; flatten it first");
      if (spec.depth > 1) refuse(where + "volumes are not read");
      const auto check = [&](const char* what, std::int64_t x, std::int64_t y, std::int64_t width,
                             std::int64_t height) {
        if (std::abs(x) > kFarthestCorner || std::abs(y) > kFarthestCorner)
          refuse(fmt::format("{}a {} that begins at ({}, {}) is not read", where, what, x, y));
        if (width < 1 || height < 1 || width > kLongestSide || height > kLongestSide || width * height > kMostPixels) {
          refuse(fmt::format("{}a {} of {} x {} pixels is not read; at most {} along a side and {} in all are", where,
                             what, width, height, kLongestSide, kMostPixels));
        }
      };
      check("data window", spec.x, spec.y, spec.width, spec.height);
      check("display window", spec.full_x, spec.full_y, spec.full_width, spec.full_height);
      if (double(spec.tile_width) * spec.tile_height * double(spec.pixel_bytes(true)) > double(kMostTileBytes))
        refuse(fmt::format("{}tiles of {} x {} pixels with {} channels are not read", where, spec.tile_width,
                           spec.tile_height, spec.nchannels));
      if (spec.nchannels < 1 || spec.nchannels > kMostChannels)
        refuse(fmt::format("{}{} channels are not read; 1 to {} are", where, spec.nchannels, kMostChannels));
      Part p;
      p.name = spec.get_string_attribute("oiio:subimagename", fmt::format("{}", part));
      p.width = spec.full_width, p.height = spec.full_height, p.left = spec.full_x, p.top = spec.full_y;
      p.x = spec.x, p.y = spec.y, p.z = spec.z;
      p.data_width = spec.width, p.data_height = spec.height;
      p.tile_height = spec.tile_width > 0 ? spec.tile_height : 0;
      p.block_rows = rows_per_block(spec.get_string_attribute("compression"));
      p.channels = spec.nchannels;
      p.display_encoded = spec.get_string_attribute("oiio:ColorSpace") == "sRGB";
      parts_.push_back(std::move(p));
      for (int i = 0; i < spec.nchannels; ++i)
        channels_.push_back({spec.channel_name(i), part, i, storage_of(spec.channelformat(i))});
    }
    // Asking for a part that is not there leaves a message behind.
    if (input->has_error()) input->geterror();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    refuse("cannot be read: its header asks for more memory than there is");
  } catch (const std::exception& e) {
    refuse(fmt::format("cannot be read: {}", e.what()));
  }
  std::map<std::string, int> uses;
  for (const auto& c : channels_) ++uses[c.name];
  for (auto& c : channels_)
    if (uses[c.name] > 1) c.name = parts_[std::size_t(c.part)].name + "." + c.name;
}

std::vector<std::string> ImageFile::channel_names() const {
  std::vector<std::string> names;
  for (const auto& c : channels_) names.push_back(c.name);
  return names;
}

int ImageFile::find(std::string_view name) const {
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].name == name) return int(i);
  return -1;
}

quell_shape ImageFile::size(int channel) const {
  const Part& part = parts_[std::size_t(channels_[std::size_t(channel)].part)];
  return {part.width, part.height, 1};
}

Window ImageFile::covered(int channel) const {
  const Part& p = parts_[std::size_t(channels_[std::size_t(channel)].part)];
  const auto clamped = [](std::int64_t v, int most) { return int(std::clamp<std::int64_t>(v, 0, most)); };
  const std::int64_t x = std::int64_t(p.x) - p.left, y = std::int64_t(p.y) - p.top;
  return {clamped(x, p.width), clamped(y, p.height), clamped(x + p.data_width, p.width),
          clamped(y + p.data_height, p.height)};
}

bool ImageFile::display_encoded(int channel) const {
  const auto& c = channels_[std::size_t(channel)];
  return parts_[std::size_t(c.part)].display_encoded &&
         (c.storage == FileChannel::Storage::byte || c.storage == FileChannel::Storage::word);
}

namespace {

// Channels [begin, end) of a part, read together.
struct Run {
  int begin, end;
  bool integer;
  std::vector<const ChannelRead*> reads;
};

void store(const float* from, int step, const ChannelRead& read, FileChannel::Storage storage, float* to, int n) {
  if (!read.id) {
    for (int x = 0; x < n; ++x) to[x] = from[std::ptrdiff_t(x) * step];
    return;
  }
  // OpenImageIO gives whole numbers of 8 and 16 bits as fractions of their largest.
  const float scale = storage == FileChannel::Storage::byte   ? 255.0f
                      : storage == FileChannel::Storage::word ? 65535.0f
                                                              : 1.0f;
  auto* ids = reinterpret_cast<std::uint32_t*>(to);
  for (int x = 0; x < n; ++x) {
    const float value = from[std::ptrdiff_t(x) * step] * scale;
    ids[x] = to_id(scale > 1.0f ? std::round(value) : value);
  }
}

void store(const std::uint32_t* from, int step, const ChannelRead& read, float* to, int n) {
  auto* ids = reinterpret_cast<std::uint32_t*>(to);
  for (int x = 0; x < n; ++x) {
    const std::uint32_t value = from[std::ptrdiff_t(x) * step];
    if (read.id) {
      ids[x] = value;
    } else {
      to[x] = float(value);
    }
  }
}

}  // namespace

void ImageFile::read(std::span<const ChannelRead> reads, std::ptrdiff_t pitch) {
  // Runs of neighbouring channels, per part.
  std::vector<const ChannelRead*> sorted;
  for (const auto& r : reads) sorted.push_back(&r);
  std::ranges::stable_sort(sorted, {}, [](const ChannelRead* r) { return r->channel; });
  std::map<int, std::vector<Run>> runs;
  for (const auto* r : sorted) {
    const auto& channel = channels_[std::size_t(r->channel)];
    if (channel.storage == FileChannel::Storage::other)
      refuse(fmt::format("channel '{}' holds signed whole numbers, which are not read", channel.name));
    const bool integer = channel.storage == FileChannel::Storage::integer;
    auto& list = runs[channel.part];
    if (list.empty() || list.back().integer != integer || (integer && channel.index > list.back().end) ||
        channel.index > list.back().end + kGap)
      list.push_back({channel.index, channel.index + 1, integer, {}});
    list.back().end = std::max(list.back().end, channel.index + 1);
    list.back().reads.push_back(r);
  }

  try {
    auto& input = *reader_->input;
    for (auto& [index, list] : runs) {
      const Part& part = parts_[std::size_t(index)];
      const Window window = covered(list.front().reads.front()->channel);
      if (window.empty()) continue;
      const int rows = part.tile_height > 0 ? std::min(part.tile_height, part.data_height) : part.block_rows;
      std::size_t widest = 0;
      for (const auto& run : list) widest = std::max(widest, std::size_t(run.end - run.begin));
      std::vector<float> strip(std::size_t(rows) * std::size_t(part.data_width) * widest);
      // Strips begin where blocks do: at the top of the data window.
      const int first = (window.y0 + part.top - part.y) / rows * rows;
      for (int top = first; top < window.y1 + part.top - part.y; top += rows) {
        const int bottom = std::min(top + rows, part.data_height);
        for (const auto& run : list) {
          const oiio::TypeDesc type = run.integer ? oiio::TypeDesc::UINT32 : oiio::TypeDesc::FLOAT;
          const bool good = part.tile_height > 0 ? input.read_tiles(index, 0, part.x, part.x + part.data_width,
                                                                    part.y + top, part.y + bottom, part.z, part.z + 1,
                                                                    run.begin, run.end, type, strip.data())
                                                 : input.read_scanlines(index, 0, part.y + top, part.y + bottom, part.z,
                                                                        run.begin, run.end, type, strip.data());
          if (!good) refuse(fmt::format("cannot be read: {}", input.geterror()));
          const int step = run.end - run.begin;
          for (int y = std::max(top + part.y - part.top, window.y0);
               y < std::min(bottom + part.y - part.top, window.y1); ++y) {
            const std::size_t row = std::size_t(y + part.top - part.y - top) * std::size_t(part.data_width);
            const std::size_t column = std::size_t(window.x0 + part.left - part.x);
            for (const auto* r : run.reads) {
              const auto& channel = channels_[std::size_t(r->channel)];
              const float* from = strip.data() + (row + column) * std::size_t(step) + (channel.index - run.begin);
              float* to = r->plane + y * pitch + window.x0;
              if (run.integer) {
                store(reinterpret_cast<const std::uint32_t*>(from), step, *r, to, window.x1 - window.x0);
              } else {
                store(from, step, *r, channel.storage, to, window.x1 - window.x0);
              }
            }
          }
        }
      }
    }
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    refuse("cannot be read: it needs more memory than there is");
  } catch (const std::exception& e) {
    refuse(fmt::format("cannot be read: {}", e.what()));
  }
}

}  // namespace quell
