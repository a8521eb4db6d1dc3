// One image file, OpenEXR or of any format that OpenImageIO reads, as named channels of planar float32.
#pragma once

#include "core/sequence/color_encoding.h"

#include <quell/abi.h>

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// Columns [x0, x1) of rows [y0, y1).
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  bool operator==(const Window&) const = default;
};
Window intersection(const Window&, const Window&);

class ImageReader;
struct ImagePart;

struct FileChannel {
  enum class Storage { floating, byte, word, integer, other };

  std::string name;  // "ViewLayer.Depth.Z"; "part.name" where two parts of the file have one channel name
  int part = 0;
  int index = 0;  // in its part
  Storage storage = Storage::floating;
};

// A channel to read and where its pixel (0, 0) goes.
struct ChannelRead {
  int channel;  // of the file
  float* plane;
  bool id = false;  // as uint32: whole numbers of the file as they are, others cast; what is none becomes kNoId
};

// Its pixels are those of the display window; the data window may cover more or less of it.
class ImageFile {
 public:
  // Opens the file and reads its headers. Throws Error(Exit::input) that names the file and says what is wrong with it:
  // it is missing or corrupt, deep, a volume, larger than 2^28 pixels or 2^17 pixels along a side.
  explicit ImageFile(std::string path);
  ~ImageFile();
  ImageFile(ImageFile&&) noexcept;

  const std::string& path() const { return path_; }
  const std::vector<FileChannel>& channels() const { return channels_; }
  std::vector<std::string> channel_names() const;
  int find(std::string_view name) const;  // index or -1

  // Attributes of the first part that are text, by name. Throws Error(Exit::input).
  std::map<std::string, std::string> texts() const;

  // Size of the display window of a channel's part.
  quell_shape size(int channel) const;
  // The part of the image that the data window covers, in pixels of the display window.
  Window covered(int channel) const;
  // Of a channel that holds colour.
  ColorEncoding encoding(int channel) const;

  // Reads the covered pixels of some channels; other pixels stay as they are. A channel may be read more than once.
  // Shares the work among the threads of the caller's arena. Throws Error(Exit::input).
  void read(std::span<const ChannelRead>, std::ptrdiff_t pitch);

 private:
  [[noreturn]] void refuse(const std::string& why) const;
  const ImagePart& part_of(int channel) const;

  std::string path_;
  std::unique_ptr<ImageReader> reader_;
  std::vector<FileChannel> channels_;
};

}  // namespace quell
