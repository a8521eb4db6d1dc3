#include "core/lab/report_pixels.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>

namespace quell {

namespace {

// Of libdeflate's 12 levels: 9 leaves 1 % less in two to seven times the time, 12 leaves 3 % less in four to 25 times.
constexpr int kLevel = 6;

std::uint16_t guess(std::uint16_t left, std::uint16_t up, std::uint16_t corner) {
  const auto [least, most] = std::minmax(left, up);
  if (corner >= most) return least;
  if (corner <= least) return most;
  return std::uint16_t(left + up - corner);
}

// Signed differences by size: 0, −1, 1, −2, 2…
std::uint16_t zigzag(std::uint16_t difference) {
  return std::uint16_t((difference << 1) ^ (difference & 0x8000 ? 0xffff : 0));
}

}  // namespace

std::vector<std::uint8_t> residuals(const HalfImage& image) {
  const std::size_t size = std::size_t(image.width) * std::size_t(image.height), width = std::size_t(image.width);
  auto planes = image.halves;
  if (image.planes == 3)
    for (std::size_t i = 0; i < size; ++i) {
      planes[i] = std::uint16_t(planes[i] - planes[size + i]);
      planes[2 * size + i] = std::uint16_t(planes[2 * size + i] - planes[size + i]);
    }
  std::vector<std::uint8_t> out(2 * planes.size());
  for (std::size_t first = 0; first < planes.size(); first += size)
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint16_t* at = &planes[first + i];
      const bool has_left = i % width != 0, has_up = i >= width;
      const auto left = has_left ? at[-1] : std::uint16_t(0), up = has_up ? *(at - width) : std::uint16_t(0);
      const auto corner = has_left && has_up ? *(at - width - 1) : std::uint16_t(0);
      const auto code = zigzag(std::uint16_t(*at - guess(left, up, corner)));
      out[first + i] = std::uint8_t(code);
      out[planes.size() + first + i] = std::uint8_t(code >> 8);
    }
  return out;
}

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::vector<std::uint8_t> packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return packed;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto have = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = std::uint32_t(bytes[i]) << 16;
    if (have > 1) group |= std::uint32_t(bytes[i + 1]) << 8;
    if (have > 2) group |= bytes[i + 2];
    for (std::size_t k = 0; k < 4; ++k) text += k <= have ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string packed_image(const HalfImage& image) {
  const auto pixels = std::size_t(std::max(0, image.width)) * std::size_t(std::max(0, image.height));
  if (pixels == 0 || (image.planes != 1 && image.planes != 3) || image.halves.size() != pixels * image.planes)
    throw std::invalid_argument(fmt::format("an image of {}x{} pixels and {} planes with {} halves", image.width,
                                            image.height, image.planes, image.halves.size()));
  return base64(deflated(residuals(image)));
}

}  // namespace quell
