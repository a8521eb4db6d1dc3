// Packs images for the report: half-float planes to text that report/pixels.js unpacks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quell {

// Planes of half-float bits, one after the other, rows from top to bottom.
struct HalfImage {
  int width = 0, height = 0;
  int planes = 0;  // 3: linear RGB; 1: one value a pixel
  std::vector<std::uint16_t> halves;
};

// Residuals of halves, taken as integers modulo 65536: of three planes the first and last become differences to the
// middle one (colours are mostly grey); of each plane what the median of left, up and left + up − corner (the predictor
// of LOCO-I, Weinberger et al. 2000) leaves, with its sign in the lowest bit. All low bytes come first, then all high
// ones. Deflated, frames take 60 to 90 % of what EXR's ZIP makes of them.
std::vector<std::uint8_t> residuals(const HalfImage&);

// zlib's format, as DecompressionStream('deflate') reads it.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t>);

// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t>);

// The three after each other. Throws std::invalid_argument for an image whose size is not that of its halves.
std::string packed_image(const HalfImage&);

}  // namespace quell
