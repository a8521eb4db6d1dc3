// Reads headers and pixels through OpenImageIO, in strips, and no channel that nobody asked for unless it lies between
// two.
#include "core/image_formats/oiio_reader.h"

#include <quell/types.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace quell {

namespace {

namespace oiio = OIIO;
using Storage = FileChannel::Storage;

// Unwanted channels between two wanted ones that cost less to read than a second call.
constexpr int kGap = 4;
constexpr int kStripRows = 16;

Storage storage_of(oiio::TypeDesc type) {
  switch (type.basetype) {
    case oiio::TypeDesc::UINT8:
      return Storage::byte;
    case oiio::TypeDesc::UINT16:
      return Storage::word;
    case oiio::TypeDesc::UINT32:
      return Storage::integer;
    case oiio::TypeDesc::HALF:
    case oiio::TypeDesc::FLOAT:
    case oiio::TypeDesc::DOUBLE:
      return Storage::floating;
    default:
      return Storage::other;
  }
}

// Of the file, not of its format's standard: PNM is Rec. 709 by its own, but no program writes or shows it so.
void take_encoding(const oiio::ImageSpec& spec, std::string_view format, ImagePart& part) {
  if (format == "pnm") return;
  part.color_space = spec.get_string_attribute("oiio:ColorSpace");
  // A gamma may stand beside a colour space that says more than it.
  const bool plain = part.color_space.empty() || part.color_space.starts_with("Gamma");
  if (plain) part.gamma = std::round(100.0 * double(spec.get_float_attribute("oiio:Gamma"))) / 100.0;
}

ImagePart part_of(const oiio::ImageSpec& spec, std::string_view format, int index) {
  ImagePart part;
  part.name = spec.get_string_attribute("oiio:subimagename", std::to_string(index));
  part.data = {spec.x, spec.y, spec.width, spec.height};
  part.display = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  if (spec.tile_width > 0) part.tile_width = spec.tile_width, part.tile_height = spec.tile_height;
  part.depth = spec.depth;
  part.pixel_bytes = spec.pixel_bytes(true);
  part.deep = spec.deep;
  take_encoding(spec, format, part);
  for (int i = 0; i < spec.nchannels; ++i)
    part.channels.push_back({spec.channel_name(i), storage_of(spec.channelformat(i))});
  return part;
}

// Channels [begin, end) of a part, read together.
struct Run {
  int begin, end;
  bool integer;
  std::vector<const ChannelRead*> reads;
};

std::vector<Run> runs_of(const ImagePart& part, std::span<const ChannelRead> reads) {
  std::vector<const ChannelRead*> sorted;
  for (const auto& r : reads) sorted.push_back(&r);
  std::ranges::stable_sort(sorted, {}, [](const ChannelRead* r) { return r->channel; });
  std::vector<Run> runs;
  for (const auto* r : sorted) {
    const bool integer = part.channels[std::size_t(r->channel)].storage == Storage::integer;
    if (runs.empty() || runs.back().integer != integer || (integer && r->channel > runs.back().end) ||
        r->channel > runs.back().end + kGap)
      runs.push_back({r->channel, r->channel + 1, integer, {}});
    runs.back().end = std::max(runs.back().end, r->channel + 1);
    runs.back().reads.push_back(r);
  }
  return runs;
}

std::uint32_t to_id(float value) {
  // The largest float below 2^32; NaN fails both comparisons.
  return value >= 0.0f && value <= 4294967040.0f ? std::uint32_t(value) : kNoId;
}

void store(const float* from, int step, bool id, Storage storage, float* to, int n) {
  if (!id) {
    for (int x = 0; x < n; ++x) to[x] = from[std::ptrdiff_t(x) * step];
    return;
  }
  // OpenImageIO gives whole numbers of 8 and 16 bits as fractions of their largest.
  const float scale = storage == Storage::byte ? 255.0f : storage == Storage::word ? 65535.0f : 1.0f;
  auto* ids = reinterpret_cast<std::uint32_t*>(to);
  for (int x = 0; x < n; ++x) {
    const float value = from[std::ptrdiff_t(x) * step] * scale;
    ids[x] = to_id(scale > 1.0f ? std::round(value) : value);
  }
}

void store(const std::uint32_t* from, int step, bool id, float* to, int n) {
  auto* ids = reinterpret_cast<std::uint32_t*>(to);
  for (int x = 0; x < n; ++x) {
    const std::uint32_t value = from[std::ptrdiff_t(x) * step];
    if (id) {
      ids[x] = value;
    } else {
      to[x] = float(value);
    }
  }
}

class OiioReader : public ImageReader {
 public:
  explicit OiioReader(const std::string& path) {
    // Channels as they are stored: not colours times alpha, and least of all normals or ids.
    oiio::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    input_ = oiio::ImageInput::open(path, &wishes);
    if (!input_) throw std::runtime_error(oiio::geterror());
    for (int i = 0; i < kMostParts && (i == 0 || input_->seek_subimage(i, 0)); ++i)
      parts_.push_back(part_of(input_->spec(), input_->format_name(), i));
    // Asking for a part that is not there leaves a message behind.
    if (input_->has_error()) input_->geterror();
  }

  std::map<std::string, std::string> texts() override {
    std::map<std::string, std::string> texts;
    for (const auto& attribute : input_->spec(0).extra_attribs)
      if (attribute.type() == oiio::TypeDesc::STRING) texts.emplace(attribute.name(), attribute.get_string());
    return texts;
  }

  void read(int index, std::span<const ChannelRead> reads, std::ptrdiff_t pitch, const Window& window) override {
    const ImagePart& part = parts_[std::size_t(index)];
    const auto runs = runs_of(part, reads);
    const int rows = part.tile_width > 0 ? std::min(part.tile_height, part.data.height) : kStripRows;
    int widest = 0;
    for (const auto& run : runs) widest = std::max(widest, run.end - run.begin);
    std::vector<float> strip(std::size_t(rows) * std::size_t(part.data.width) * std::size_t(widest));
    const int down = part.display.y - part.data.y, right = part.display.x - part.data.x;
    for (int top = (window.y0 + down) / rows * rows; top < window.y1 + down; top += rows) {
      const int bottom = std::min(top + rows, part.data.height);
      for (const auto& run : runs) {
        fetch(index, run, top, bottom, strip.data());
        const int step = run.end - run.begin;
        for (int y = std::max(top - down, window.y0); y < std::min(bottom - down, window.y1); ++y) {
          const std::size_t pixel =
              std::size_t(y + down - top) * std::size_t(part.data.width) + std::size_t(window.x0 + right);
          for (const auto* r : run.reads) {
            const float* from = strip.data() + pixel * std::size_t(step) + (r->channel - run.begin);
            float* to = r->plane + y * pitch + window.x0;
            const int n = window.x1 - window.x0;
            if (run.integer) {
              store(reinterpret_cast<const std::uint32_t*>(from), step, r->id, to, n);
            } else {
              store(from, step, r->id, part.channels[std::size_t(r->channel)].storage, to, n);
            }
          }
        }
      }
    }
  }

 private:
  void fetch(int index, const Run& run, int top, int bottom, float* strip) {
    const auto& part = parts_[std::size_t(index)];
    const auto& data = part.data;
    const int z = input_->spec_dimensions(index).z;
    const oiio::TypeDesc type = run.integer ? oiio::TypeDesc::UINT32 : oiio::TypeDesc::FLOAT;
    const bool good =
        part.tile_width > 0
            ? input_->read_tiles(index, 0, data.x, data.x + data.width, data.y + top, data.y + bottom, z, z + 1,
                                 run.begin, run.end, type, strip)
            : input_->read_scanlines(index, 0, data.y + top, data.y + bottom, z, run.begin, run.end, type, strip);
    if (!good) throw std::runtime_error(input_->geterror());
  }

  std::unique_ptr<oiio::ImageInput> input_;
};

}  // namespace

std::unique_ptr<ImageReader> open_by_oiio(const std::string& path) { return std::make_unique<OiioReader>(path); }

}  // namespace quell
