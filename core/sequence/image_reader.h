// What ImageFile reads through: one class for OpenEXR, one for all other formats.
#pragma once

#include "core/sequence/image_file.h"

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace quell {

// One part (page, subimage) of a file, as its header has it; nothing is checked yet. Windows are in the file's own
// coordinates.
struct ImagePart {
  struct Channel {
    std::string name;
    FileChannel::Storage storage;
    bool operator==(const Channel&) const = default;
  };
  struct Box {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Box&) const = default;
  };

  std::string name;
  Box data, display;
  int tile_width = 0, tile_height = 0;  // 0: scan lines
  int depth = 1;                        // of a volume
  bool deep = false;
  std::string color_space;  // as the file states it, by its name in OpenImageIO
  double gamma = 0;         // as the file states it, or 0
  std::vector<Channel> channels;
  std::size_t pixel_bytes = 0;  // of all channels, in the file

  bool operator==(const ImagePart&) const = default;
};

class ImageReader {
 public:
  virtual ~ImageReader() = default;
  const std::vector<ImagePart>& parts() const { return parts_; }

  // Attributes of the first part that are text.
  virtual std::map<std::string, std::string> texts() = 0;

  // Reads channels of a part (`channel` is the index in the part). `window` is what to read, in pixels of the display
  // window, and lies within the data window. Throws std::exception with the reason.
  virtual void read(int part, std::span<const ChannelRead> reads, std::ptrdiff_t pitch, const Window& window) = 0;

 protected:
  std::vector<ImagePart> parts_;
};

// More parts than this of a file are passed over.
inline constexpr int kMostParts = 256;

}  // namespace quell
