// OpenEXR reads headers and fetches blocks; pieces of some rows go straight into the planes that were asked for.
//
// Blocks that are stored as they are or by ZIP, which is what nearly all renderers write, are unpacked here, in about a
// third of OpenEXR's time. Blocks of other compressions and tiles OpenEXR unpacks, of the channels that are wanted.
#include "core/sequence/exr_reader.h"

#include "core/sequence/exr_block.h"
#include "core/sequence/exr_layout.h"
#include "core/sequence/pieces.h"

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace quell {

namespace {

// Rows of a piece: enough to outweigh what a piece costs, few enough to share a frame among many threads.
constexpr int kRowsUnpackedHere = 16;
constexpr int kRowsUnpackedThere = 128;

bool unpacked_here(const ExrLayout& layout) {
  return !layout.tiled() && (layout.compression == Imf::NO_COMPRESSION || layout.compression == Imf::ZIPS_COMPRESSION ||
                             layout.compression == Imf::ZIP_COMPRESSION);
}

// What one thread needs: the file opened for itself, for OpenEXR lets one at a time read from an open file, and memory.
struct Hand {
  Imf::MultiPartInputFile file;
  ExrInflater inflater;
  Scratch packed, strip;

  explicit Hand(const std::string& path) : file(path.c_str(), 0) {}
};

// OpenEXR says 'Error reading pixel data from image file "shot.exr". Tile 4 is missing.': whoever catches this has
// named the file already.
template <class Action>
void without_path(const std::string& path, Action action) {
  try {
    action();
  } catch (const Iex::BaseExc& e) {
    const std::string text = e.what(), named = "\"" + path + "\". ";
    const auto at = text.rfind(named);
    throw std::runtime_error(at == text.npos ? text : text.substr(at + named.size()));
  }
}

// Channels of a part into planes.
struct Task {
  int part;
  const ExrLayout& layout;
  std::span<const ChannelRead> reads;
  std::ptrdiff_t pitch;
  Window window;    // of the display window
  int down, right;  // from its pixels to those of the data window

  // Rows [y, y + rows) of the data window lie in blocks; bytes(read, row) are those of one row of it.
  template <class Bytes>
  void deliver(int y, int rows, Bytes bytes) const {
    for (int row = std::max(0, window.y0 + down - y); row < std::min(rows, window.y1 + down - y); ++row)
      for (std::size_t r = 0; r < reads.size(); ++r) {
        const auto& channel = layout.channels[std::size_t(reads[r].channel)];
        const std::size_t skipped = std::size_t(window.x0 + right) * channel.bytes();
        float* to = reads[r].plane + (y + row - down) * pitch + window.x0;
        bytes(r, row).from(skipped).read(channel.type, reads[r].id, to, std::size_t(window.x1 - window.x0));
      }
  }
};

void unpack_here(Hand& hand, const Task& task, int y, int rows) {
  const ExrLayout& layout = task.layout;
  const std::size_t width = std::size_t(layout.part.data.width), row_bytes = layout.part.pixel_bytes * width;
  Imf::InputPart part(hand.file, task.part);
  // OpenEXR refuses blocks of more bytes than this.
  auto* packed = hand.packed.bytes(row_bytes * std::size_t(layout.block_rows()));
  int packed_size = 0;
  part.rawPixelDataToBuffer(layout.part.data.y + y, reinterpret_cast<char*>(packed), packed_size);
  const std::size_t size = row_bytes * std::size_t(rows);
  ExrBytes block{packed};
  // What ZIP would have made longer is stored as it is.
  if (packed_size < 0 || std::size_t(packed_size) < size) {
    if (packed_size < 0 || layout.compression == Imf::NO_COMPRESSION)
      throw std::runtime_error("a block of pixels is cut short");
    block = hand.inflater.inflate(packed, std::size_t(packed_size), size);
  }
  task.deliver(y, rows, [&](std::size_t r, int row) {
    const auto& channel = layout.channels[std::size_t(task.reads[r].channel)];
    return block.from(std::size_t(row) * row_bytes + channel.before * width);
  });
}

void unpack_there(Hand& hand, const Task& task, int y, int rows) {
  const auto& data = task.layout.part.data;
  const std::size_t row_bytes = std::size_t(data.width) * sizeof(float), plane = row_bytes * std::size_t(rows);
  std::uint8_t* strip = hand.strip.bytes(plane * task.reads.size());
  Imf::FrameBuffer buffer;
  std::vector<const std::uint8_t*> planes;
  for (const auto& read : task.reads) {
    const auto& channel = task.layout.channels[std::size_t(read.channel)];
    // A channel that is read twice needs one plane.
    const auto same = std::ranges::find(task.reads, read.channel, &ChannelRead::channel) - task.reads.begin();
    planes.push_back(strip + std::size_t(same) * plane);
    buffer.insert(channel.name, Imf::Slice::Make(channel.type, planes.back(), Imath::V2i(data.x, data.y + y),
                                                 data.width, rows, channel.bytes(), row_bytes));
  }
  Imf::InputPart part(hand.file, task.part);
  part.setFrameBuffer(buffer);
  part.readPixels(data.y + y, data.y + y + rows - 1);
  task.deliver(y, rows, [&](std::size_t r, int row) { return ExrBytes{planes[r] + std::size_t(row) * row_bytes}; });
}

class ExrReader : public ImageReader {
 public:
  explicit ExrReader(const std::string& path) : path_(path) {
    without_path(path_, [&] {
      auto hand = std::make_unique<Hand>(path);
      for (int i = 0; i < std::min(hand->file.parts(), kMostParts); ++i) {
        layouts_.emplace_back(hand->file.header(i), i);
        parts_.push_back(layouts_.back().part);
      }
      hands_.give_back(std::move(hand));
    });
  }

  std::map<std::string, std::string> texts() override {
    std::map<std::string, std::string> texts;
    auto hand = hands_.take([&] { return open_again(0); });
    const auto& header = hand->file.header(0);
    for (auto it = header.begin(); it != header.end(); ++it)
      if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(it.name()))
        texts.emplace(it.name(), text->value());
    hands_.give_back(std::move(hand));
    return texts;
  }

  void read(int part, std::span<const ChannelRead> reads, std::ptrdiff_t pitch, const Window& window) override {
    const ExrLayout& layout = layouts_[std::size_t(part)];
    const auto &data = layout.part.data, &display = layout.part.display;
    const Task task{part, layout, reads, pitch, window, display.y - data.y, display.x - data.x};
    const bool here = unpacked_here(layout);
    const int block = std::min(layout.block_rows(), data.height);
    const int rows = std::max(1, (here ? kRowsUnpackedHere : kRowsUnpackedThere) / block) * block;
    // Pieces begin where blocks do: at the top of the data window.
    const int top = window.y0 + task.down, bottom = window.y1 + task.down, first = top / rows;
    const auto piece = [&](int i) {
      auto hand = hands_.take([&] { return open_again(part); });
      const int begin = (first + i) * rows, end = std::min(begin + rows, bottom);
      for (int y = begin; y < end; y += block)
        if (y + block > top) (here ? unpack_here : unpack_there)(*hand, task, y, std::min(block, data.height - y));
      hands_.give_back(std::move(hand));
    };
    without_path(path_, [&] { in_pieces((bottom + rows - 1) / rows - first, piece); });
  }

 private:
  std::unique_ptr<Hand> open_again(int part) const {
    auto hand = std::make_unique<Hand>(path_);
    if (part >= hand->file.parts() || ExrLayout(hand->file.header(part), part) != layouts_[std::size_t(part)])
      throw std::runtime_error("it changed while it was read");
    return hand;
  }

  std::string path_;
  std::vector<ExrLayout> layouts_;
  Pool<Hand> hands_;
};

}  // namespace

bool is_exr(const std::string& path) {
  char begin[4] = {};
  std::ifstream(path, std::ios::binary).read(begin, sizeof begin);
  return std::string_view(begin, sizeof begin) == "\x76\x2f\x31\x01";
}

std::unique_ptr<ImageReader> open_exr(const std::string& path) { return std::make_unique<ExrReader>(path); }

}  // namespace quell
