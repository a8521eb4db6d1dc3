// Opens a file by the reader of its format, refuses what its header says that no run can use, and knows its channels.
#include "core/sequence/image_file.h"

#include "core/report/error.h"
#include "core/sequence/exr_reader.h"
#include "core/sequence/image_formats.h"
#include "core/sequence/image_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <new>

namespace quell {

namespace {

constexpr std::int64_t kMostPixels = std::int64_t(1) << 28;
constexpr std::int64_t kLongestSide = std::int64_t(1) << 17;
constexpr std::int64_t kFarthestCorner = std::int64_t(1) << 24;  // so that sums of coordinates stay in range
// OpenEXR unpacks a whole tile, with all its channels, however small the image is.
constexpr std::int64_t kMostTileBytes = std::int64_t(1) << 28;
constexpr std::size_t kMostChannels = 1024;

std::string problem_of(const char* what, const ImagePart::Box& box) {
  if (std::abs(std::int64_t(box.x)) > kFarthestCorner || std::abs(std::int64_t(box.y)) > kFarthestCorner)
    return fmt::format("a {} that begins at ({}, {}) is not read", what, box.x, box.y);
  if (box.width >= 1 && box.height >= 1 && box.width <= kLongestSide && box.height <= kLongestSide &&
      std::int64_t(box.width) * box.height <= kMostPixels)
    return "";
  return fmt::format("a {} of {} x {} pixels is not read; at most {} along a side and {} in all are", what, box.width,
                     box.height, kLongestSide, kMostPixels);
}

// "" for a part that can be read.
std::string problem_of(const ImagePart& part) {
  if (part.deep) return "deep images are not read; flatten it first";
  if (part.depth > 1) return "volumes are not read";
  if (auto problem = problem_of("data window", part.data); !problem.empty()) return problem;
  if (auto problem = problem_of("display window", part.display); !problem.empty()) return problem;
  if (double(part.tile_width) * part.tile_height * double(part.pixel_bytes) > double(kMostTileBytes))
    return fmt::format("tiles of {} x {} pixels with {} channels are not read", part.tile_width, part.tile_height,
                       part.channels.size());
  if (part.channels.empty() || part.channels.size() > kMostChannels)
    return fmt::format("{} channels are not read; 1 to {} are", part.channels.size(), kMostChannels);
  return "";
}

}  // namespace

Window intersection(const Window& a, const Window& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

ImageFile::ImageFile(ImageFile&&) noexcept = default;
ImageFile::~ImageFile() = default;

void ImageFile::refuse(const std::string& why) const { throw Error(Exit::input, fmt::format("{}: {}", path_, why)); }

ImageFile::ImageFile(std::string path) : path_(std::move(path)) {
  std::error_code error;
  const auto status = std::filesystem::status(path_, error);
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  if (std::filesystem::is_directory(status)) refuse("is a folder, not an image");
  // Any exception of a codec is a damaged file, and so is an allocation that only a damaged header asks for.
  try {
    reader_ = is_exr(path_) ? open_exr(path_) : image_formats().open(path_);
  } catch (const std::bad_alloc&) {
    refuse("cannot be read: its header asks for more memory than there is");
  } catch (const std::exception& e) {
    refuse(fmt::format("cannot be read: {}", e.what()));
  }
  const auto& parts = reader_->parts();
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (const auto problem = problem_of(parts[part]); !problem.empty())
      refuse(part ? fmt::format("part {}: {}", part, problem) : problem);
    for (std::size_t i = 0; i < parts[part].channels.size(); ++i)
      channels_.push_back({parts[part].channels[i].name, int(part), int(i), parts[part].channels[i].storage});
  }
  std::map<std::string, int> uses;
  for (const auto& c : channels_) ++uses[c.name];
  for (auto& c : channels_)
    if (uses[c.name] > 1) c.name = parts[std::size_t(c.part)].name + "." + c.name;
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

std::map<std::string, std::string> ImageFile::texts() const {
  try {
    return reader_->texts();
  } catch (const std::exception& e) {
    refuse(fmt::format("its attributes cannot be read: {}", e.what()));
  }
}

const ImagePart& ImageFile::part_of(int channel) const {
  return reader_->parts()[std::size_t(channels_[std::size_t(channel)].part)];
}

quell_shape ImageFile::size(int channel) const {
  const auto& display = part_of(channel).display;
  return {display.width, display.height, 1};
}

Window ImageFile::covered(int channel) const {
  const auto &data = part_of(channel).data, &display = part_of(channel).display;
  const auto clamped = [](std::int64_t v, int most) { return int(std::clamp<std::int64_t>(v, 0, most)); };
  const std::int64_t x = std::int64_t(data.x) - display.x, y = std::int64_t(data.y) - display.y;
  return {clamped(x, display.width), clamped(y, display.height), clamped(x + data.width, display.width),
          clamped(y + data.height, display.height)};
}

ColorEncoding ImageFile::encoding(int channel) const {
  const auto storage = channels_[std::size_t(channel)].storage;
  const auto& part = part_of(channel);
  return color_encoding(part.color_space, part.gamma,
                        storage == FileChannel::Storage::byte || storage == FileChannel::Storage::word);
}

void ImageFile::read(std::span<const ChannelRead> reads, std::ptrdiff_t pitch) {
  std::map<int, std::vector<ChannelRead>> by_part;
  for (auto read : reads) {
    const auto& channel = channels_[std::size_t(read.channel)];
    if (channel.storage == FileChannel::Storage::other)
      refuse(fmt::format("channel '{}' holds signed whole numbers, which are not read", channel.name));
    if (covered(read.channel).empty()) continue;
    read.channel = channel.index;
    by_part[channel.part].push_back(read);
  }
  try {
    for (const auto& [part, list] : by_part) {
      const auto first = std::ranges::find(channels_, part, &FileChannel::part) - channels_.begin();
      reader_->read(part, list, pitch, covered(int(first)));
    }
  } catch (const std::bad_alloc&) {
    refuse("cannot be read: it needs more memory than there is");
  } catch (const std::exception& e) {
    refuse(fmt::format("cannot be read: {}", e.what()));
  }
}

}  // namespace quell
