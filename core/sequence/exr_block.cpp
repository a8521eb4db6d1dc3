// Deflates and inflates with libdeflate, which takes a fraction of zlib's time; SIMD does the rest.
#include "core/sequence/exr_block.h"

#include "core/sequence/exr_kernels.h"

#include <quell/types.h>

#include <libdeflate.h>

#include <bit>
#include <cstring>
#include <new>
#include <stdexcept>

namespace quell {

static_assert(std::endian::native == std::endian::little, "OpenEXR's numbers are little-endian");

namespace {

std::uint32_t to_id(float value) {
  // The largest float below 2^32; NaN fails both comparisons.
  return value >= 0.0f && value <= 4294967040.0f ? std::uint32_t(value) : kNoId;
}

}  // namespace

void ExrBytes::read(Imf::PixelType type, bool id, float* to, std::size_t n) const {
  if (type == Imf::HALF) {
    if (odd) {
      halves_to_floats(even, odd, to, n);
    } else {
      halves_to_floats(even, to, n);
    }
  } else if (odd) {
    join_bytes(even, odd, reinterpret_cast<std::uint8_t*>(to), 2 * n);
  } else {
    std::memcpy(to, even, n * sizeof(float));
  }
  const bool whole = type == Imf::UINT;
  if (whole == id) return;
  for (std::size_t i = 0; i < n; ++i)
    to[i] = whole ? float(std::bit_cast<std::uint32_t>(to[i])) : std::bit_cast<float>(to_id(to[i]));
}

void ExrInflater::Free::operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }

ExrInflater::ExrInflater() : decompressor_(libdeflate_alloc_decompressor()) {
  if (!decompressor_) throw std::bad_alloc();
}

ExrBytes ExrInflater::inflate(const std::uint8_t* packed, std::size_t packed_size, std::size_t size) {
  std::uint8_t* bytes = scratch_.bytes(size);
  // Without a place for the size that comes out, any other than `size` is an error.
  if (libdeflate_zlib_decompress(decompressor_.get(), packed, packed_size, bytes, size, nullptr) != LIBDEFLATE_SUCCESS)
    throw std::runtime_error("a block of pixels is damaged");
  sum_differences(bytes, size);
  return {bytes, bytes + (size + 1) / 2};
}

namespace {

template <class Row>
void for_rows(std::span<const ExrPlane> planes, int top, int bottom, Row row) {
  for (int y = top; y < bottom; ++y)
    for (const auto& plane : planes) row(plane, plane.numbers + y * plane.pitch);
}

void store_whole(std::span<const ExrPlane> planes, std::size_t width, int top, int bottom, char* to) {
  for_rows(planes, top, bottom, [&](const ExrPlane& plane, const float* row) {
    if (plane.type == Imf::HALF) {
      floats_to_halves(row, reinterpret_cast<std::uint16_t*>(to), width);
    } else {
      std::memcpy(to, row, plane.bytes() * width);
    }
    to += plane.bytes() * width;
  });
}

void store_split(std::span<const ExrPlane> planes, std::size_t width, int top, int bottom, std::uint8_t* even,
                 std::uint8_t* odd) {
  for_rows(planes, top, bottom, [&](const ExrPlane& plane, const float* row) {
    const std::size_t pairs = plane.bytes() * width / 2;
    if (plane.type == Imf::HALF) {
      floats_to_halves(row, even, odd, pairs);
    } else {
      split_bytes(reinterpret_cast<const std::uint8_t*>(row), even, odd, pairs);
    }
    even += pairs, odd += pairs;
  });
}

}  // namespace

void ExrPacker::Free::operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }

ExrPacker::ExrPacker(int level) : compressor_(level > 0 ? libdeflate_alloc_compressor(level) : nullptr) {
  if (level > 0 && !compressor_) throw std::bad_alloc();
}

std::vector<char> ExrPacker::pack(std::span<const ExrPlane> planes, int width, int top, int bottom) {
  const auto columns = std::size_t(width);
  std::size_t size = 0;
  for (const auto& plane : planes) size += plane.bytes() * columns * std::size_t(bottom - top);
  std::vector<char> block(size);
  if (compressor_) {
    std::uint8_t *split = split_.bytes(size), *differences = differences_.bytes(size);
    store_split(planes, columns, top, bottom, split, split + size / 2);
    take_differences(split, differences, size);
    // 0 when it would not be shorter: then it is stored as it is, and whoever reads tells by the size.
    const auto packed = libdeflate_zlib_compress(compressor_.get(), differences, size, block.data(), size - 1);
    if (packed > 0) {
      block.resize(packed);
      block.shrink_to_fit();
      return block;
    }
  }
  store_whole(planes, columns, top, bottom, block.data());
  return block;
}

}  // namespace quell
