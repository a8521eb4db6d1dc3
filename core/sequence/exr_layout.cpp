// From OpenEXR's headers to layouts.
#include "core/sequence/exr_layout.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescription.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string_view>
#include <tuple>

namespace quell {

namespace {

ImagePart::Box box_of(const Imath::Box2i& box) {
  // Corners of damaged headers may lie farther apart than an int can say.
  const auto length = [](int min, int max) {
    return int(std::clamp<std::int64_t>(std::int64_t(max) - min + 1, 0, std::int64_t(1) << 30));
  };
  return {box.min.x, box.min.y, length(box.min.x, box.max.x), length(box.min.y, box.max.y)};
}

struct Name {
  std::string layer, last;
  explicit Name(const std::string& name) {
    const auto dot = name.rfind('.');
    if (dot != name.npos) layer = name.substr(0, dot + 1);
    last = name.substr(layer.size());
  }
};

// OpenEXR orders channels by name; people expect R G B A and depth first in each layer, but X Y Z W where there is X.
void sort(std::vector<ExrLayout::Channel>& channels) {
  static constexpr std::string_view kFirst[] = {"r",    "red", "g",     "green", "b",    "blue", "real",
                                                "imag", "a",   "alpha", "ar",    "ra",   "ag",   "ga",
                                                "ab",   "ba",  "z",     "depth", "zback"};
  static constexpr std::string_view kVector = "xyzw";
  const auto lower_case = [](std::string text) {
    for (char& c : text)
      if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
  };
  std::set<std::string> vectors;  // layers that have X
  for (const auto& c : channels)
    if (const Name name(c.name); lower_case(name.last) == "x") vectors.insert(name.layer);
  std::ranges::stable_sort(channels, {}, [&](const ExrLayout::Channel& c) {
    const Name name(c.name);
    const auto last = lower_case(name.last);
    std::size_t rank = std::size_t(std::ranges::find(kFirst, last) - std::begin(kFirst));
    if (vectors.contains(name.layer) && last.size() == 1 && kVector.find(last) != kVector.npos)
      rank = std::size(kFirst) + kVector.find(last);
    else if (rank == std::size(kFirst))
      rank += kVector.size();
    return std::tuple(name.layer, rank, name.last);
  });
}

}  // namespace

ExrLayout::ExrLayout(const Imf::Header& header, int index) : compression(header.compression()) {
  part.name = header.hasName() ? header.name() : fmt::format("{}", index);
  part.data = box_of(header.dataWindow());
  part.display = box_of(header.displayWindow());
  part.deep = header.hasType() && Imf::isDeepData(header.type());
  if (header.hasTileDescription()) {
    const auto& tiles = header.tileDescription();
    part.tile_width = int(std::min(tiles.xSize, 1u << 30)), part.tile_height = int(std::min(tiles.ySize, 1u << 30));
  }
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    const Imf::Channel& channel = it.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1)
      throw std::runtime_error(fmt::format("Subsampled channels are not supported (channel \"{}\" has sampling {},{}).",
                                           it.name(), channel.xSampling, channel.ySampling));
    channels.push_back({it.name(), channel.type, part.pixel_bytes});
    part.pixel_bytes += channels.back().bytes();
  }
  sort(channels);
  for (const auto& c : channels)
    part.channels.push_back(
        {c.name, c.type == Imf::UINT ? FileChannel::Storage::integer : FileChannel::Storage::floating});
}

int ExrLayout::block_rows() const {
  if (tiled()) return part.tile_height;
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 32;
  }
}

}  // namespace quell
