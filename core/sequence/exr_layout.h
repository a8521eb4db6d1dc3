// How the pixels of one part of an OpenEXR file are stored, as its header says.
#pragma once

#include "core/sequence/image_reader.h"

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfForward.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <string>
#include <vector>

namespace quell {

struct ExrLayout {
  struct Channel {
    std::string name;
    Imf::PixelType type;
    std::size_t before;  // bytes of a pixel in the channels that precede it in a row
    std::size_t bytes() const { return type == Imf::HALF ? 2 : 4; }
    bool operator==(const Channel&) const = default;
  };

  ImagePart part;
  std::vector<Channel> channels;  // in the order of part.channels
  Imf::Compression compression = Imf::NO_COMPRESSION;

  // `index` names a part without a name. Throws std::runtime_error when channels are subsampled.
  ExrLayout(const Imf::Header& header, int index);

  bool tiled() const { return part.tile_width > 0; }
  // Rows that are packed together.
  int block_rows() const;
  bool operator==(const ExrLayout&) const = default;
};

}  // namespace quell
