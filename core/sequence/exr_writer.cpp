// OpenEXR writes the header. Blocks that are stored as they are or by ZIP are packed here, each a piece of its own, in
// about a third of OpenEXR's time; those of other compressions OpenEXR packs.
#include "core/sequence/exr_writer.h"

#include "core/sequence/exr_block.h"
#include "core/sequence/exr_kernels.h"
#include "core/sequence/pieces.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace quell {

namespace {

// In the order of Imf::Compression.
const std::array<std::string, Imf::NUM_COMPRESSION_METHODS> kNames = {"none",  "rle", "zips", "zip",  "piz",
                                                                      "pxr24", "b44", "b44a", "dwaa", "dwab"};
// Rows that OpenEXR gets at once: a multiple of the rows of any block.
constexpr int kStripRows = 256;
// Files of the length that level 4 of zlib makes, OpenEXR's choice, in a third of its time.
constexpr int kZipLevel = 1;
constexpr int kLargestZipLevel = 12;
constexpr int kLargestDwaLevel = 100000;

class Memory : public Imf::OStream {
 public:
  Memory() : OStream("memory") {}
  void write(const char* bytes, int n) override {
    const std::size_t end = at_ + std::size_t(n);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, bytes, std::size_t(n));
    at_ = end;
  }
  template <class Number>
  void write(Number number) {
    write(reinterpret_cast<const char*>(&number), int(sizeof number));
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = std::size_t(at); }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  std::vector<char> take() { return std::move(bytes_); }

 private:
  std::vector<char> bytes_;
  std::size_t at_ = 0;
};

Imf::PixelType pixel_type(ExrChannel::Storage storage) {
  switch (storage) {
    case ExrChannel::Storage::half:
      return Imf::HALF;
    case ExrChannel::Storage::integer:
      return Imf::UINT;
    default:
      return Imf::FLOAT;
  }
}

// Planes in the order in which the file has them: that of their names.
std::vector<ExrPlane> in_file_order(const quell_image& image, std::span<const ExrChannel> channels) {
  std::vector<std::size_t> order(channels.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return channels[i].name; });
  std::vector<ExrPlane> planes;
  for (const std::size_t i : order) planes.push_back({image.plane[i], image.pitch, pixel_type(channels[i].storage)});
  return planes;
}

void write_packed_here(Memory& out, const Imf::Header& header, const quell_image& image,
                       std::span<const ExrPlane> planes, int block_rows, int level) {
  constexpr std::int32_t kMagic = 20000630, kVersion = 2;
  out.write(kMagic);
  out.write(kVersion);
  header.writeTo(out);
  const int blocks = (image.height + block_rows - 1) / block_rows;
  std::vector<std::vector<char>> packed(static_cast<std::size_t>(blocks));
  Pool<ExrPacker> packers;
  in_pieces(blocks, [&](int i) {
    auto packer = packers.take([level] { return std::make_unique<ExrPacker>(level); });
    const int top = i * block_rows;
    packed[std::size_t(i)] = packer->pack(planes, image.width, top, std::min(image.height, top + block_rows));
    packers.give_back(std::move(packer));
  });
  std::size_t at = std::size_t(out.tellp()) + sizeof(std::uint64_t) * packed.size(), end = at;
  for (const auto& block : packed) end += 2 * sizeof(std::int32_t) + block.size();
  out.reserve(end);
  for (const auto& block : packed) {
    out.write(std::uint64_t(at));
    at += 2 * sizeof(std::int32_t) + block.size();
  }
  for (int i = 0; i < blocks; ++i) {
    auto& block = packed[std::size_t(i)];
    out.write(std::int32_t(i * block_rows));
    out.write(std::int32_t(block.size()));
    out.write(block.data(), int(block.size()));
  }
}

void write_packed_there(Memory& out, const Imf::Header& header, const quell_image& image,
                        std::span<const ExrPlane> planes) {
  Imf::OutputFile file(out, header, 0);
  const auto width = std::size_t(image.width);
  Scratch halves;
  for (int top = 0; top < image.height; top += kStripRows) {
    const int rows = std::min(kStripRows, image.height - top);
    auto* half = reinterpret_cast<std::uint16_t*>(halves.bytes(width * std::size_t(rows) * planes.size() * 2));
    Imf::FrameBuffer buffer;
    auto channel = header.channels().begin();
    for (const auto& plane : planes) {
      const Imath::V2i origin(0, top);
      const float* first = plane.numbers + top * plane.pitch;
      const std::size_t pitch = std::size_t(plane.pitch) * sizeof(float);
      if (plane.type == Imf::HALF) {
        for (int y = 0; y < rows; ++y) floats_to_halves(first + y * plane.pitch, half + std::size_t(y) * width, width);
        buffer.insert(channel.name(),
                      Imf::Slice::Make(Imf::HALF, half, origin, image.width, rows, std::size_t(2), 2 * width));
        half += width * std::size_t(rows);
      } else {
        buffer.insert(channel.name(),
                      Imf::Slice::Make(plane.type, first, origin, image.width, rows, sizeof(float), pitch));
      }
      ++channel;
    }
    file.setFrameBuffer(buffer);
    file.writePixels(rows);
  }
}

}  // namespace

std::span<const std::string> exr_compressions() { return kNames; }

std::optional<ExrCompression> parse_exr_compression(std::string_view text) {
  const auto colon = std::min(text.find(':'), text.size());
  ExrCompression out{std::string(text.substr(0, colon)), {}};
  if (std::ranges::find(kNames, out.name) == kNames.end()) return std::nullopt;
  if (colon == text.size()) return out;
  const bool zip = out.name.starts_with("zip"), dwa = out.name.starts_with("dwa");
  int level = 0;
  const char *begin = text.data() + colon + 1, *end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, level);
  const bool fits = zip ? level >= 1 && level <= kLargestZipLevel : dwa && level >= 0 && level <= kLargestDwaLevel;
  if (error != std::errc() || stop != end || !fits) return std::nullopt;
  out.level = level;
  return out;
}

std::vector<char> encode_exr(const quell_image& image, std::span<const ExrChannel> channels,
                             const ExrCompression& compression, const std::map<std::string, std::string>& metadata) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::Compression(std::ranges::find(kNames, compression.name) - kNames.begin());
  for (const auto& c : channels) header.channels().insert(c.name, Imf::Channel(pixel_type(c.storage)));
  for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
  const auto planes = in_file_order(image, channels);
  Memory out;
  switch (header.compression()) {
    case Imf::NO_COMPRESSION:
      write_packed_here(out, header, image, planes, 1, 0);
      break;
    case Imf::ZIPS_COMPRESSION:
      write_packed_here(out, header, image, planes, 1, compression.level.value_or(kZipLevel));
      break;
    case Imf::ZIP_COMPRESSION:
      write_packed_here(out, header, image, planes, 16, compression.level.value_or(kZipLevel));
      break;
    default:
      if (compression.level) header.dwaCompressionLevel() = float(*compression.level);
      write_packed_there(out, header, image, planes);
  }
  return out.take();
}

}  // namespace quell
