// Blocks of OpenEXR files that are stored as they are or by ZIP: unpacked and packed.
#pragma once

#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;
struct libdeflate_decompressor;

namespace quell {

// Memory that grows and keeps no values.
class Scratch {
 public:
  std::uint8_t* bytes(std::size_t n) {
    if (n > size_) {
      memory_.reset();
      memory_ = std::make_unique_for_overwrite<std::uint8_t[]>(n);
      size_ = n;
    }
    return memory_.get();
  }

 private:
  std::unique_ptr<std::uint8_t[]> memory_;
  std::size_t size_ = 0;
};

// Bytes of numbers in a row: as they are, or (when `odd` is not null) the even and the odd ones apart.
struct ExrBytes {
  const std::uint8_t* even = nullptr;
  const std::uint8_t* odd = nullptr;

  // What begins an even number of bytes further on.
  ExrBytes from(std::size_t offset) const {
    return odd ? ExrBytes{even + offset / 2, odd + offset / 2} : ExrBytes{even + offset, nullptr};
  }
  // The first n of them as floats; with `id` as uint32, where what is none becomes kNoId.
  void read(Imf::PixelType type, bool id, float* to, std::size_t n) const;
};

class ExrInflater {
 public:
  ExrInflater();
  // The `size` bytes of a block whose `packed_size` bytes ZIP made. Valid until the next call. Throws
  // std::runtime_error when they are damaged.
  ExrBytes inflate(const std::uint8_t* packed, std::size_t packed_size, std::size_t size);

 private:
  struct Free {
    void operator()(libdeflate_decompressor*) const;
  };
  std::unique_ptr<libdeflate_decompressor, Free> decompressor_;
  Scratch scratch_;
};

// A plane to be stored; its numbers are floats, or uint32 for UINT.
struct ExrPlane {
  const float* numbers;
  std::ptrdiff_t pitch;
  Imf::PixelType type;
  std::size_t bytes() const { return type == Imf::HALF ? 2 : 4; }
};

class ExrPacker {
 public:
  // level 0 stores numbers as they are; 1 to 12 deflate them, the higher the smaller and slower.
  explicit ExrPacker(int level);
  // The block of rows [top, bottom), its channels in this order.
  std::vector<char> pack(std::span<const ExrPlane> planes, int width, int top, int bottom);

 private:
  struct Free {
    void operator()(libdeflate_compressor*) const;
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_;  // null: none
  Scratch split_, differences_;
};

}  // namespace quell
