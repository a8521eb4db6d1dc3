// The library for all image formats but OpenEXR.
//
// OpenImageIO brings some 260 libraries along, whose loading takes longer than most commands run, and nearly all that
// we read and write is OpenEXR. So what uses it is a library of its own, core/image_formats/, beside the plugins; it is
// opened when the first file of another format comes up.
#pragma once

#include "core/sequence/image_reader.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace quell {

struct ImageFormats {
  const char* version;  // of Quell; only its own library fits

  // Reads headers. Throws std::runtime_error with the reason when they cannot be read.
  std::unique_ptr<ImageReader> (*open)(const std::string& path);

  // The whole file. `pixels` are interleaved; names of the metadata are OpenImageIO's. Throws std::runtime_error.
  std::vector<unsigned char> (*encode_png)(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                           const std::map<std::string, std::string>& metadata);
};

// Opens the library, once. Throws std::runtime_error when it is not there or does not fit.
const ImageFormats& image_formats();

}  // namespace quell

// What the library exports.
extern "C" const quell::ImageFormats* quell_image_formats();
