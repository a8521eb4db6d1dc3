// OpenEXR files: flat images in scan lines or tiles, of one part or many.
#pragma once

#include "core/sequence/image_reader.h"

#include <memory>
#include <string>

namespace quell {

// Whether a file begins as OpenEXR files do.
bool is_exr(const std::string& path);

// Reads headers. Throws std::exception with the reason when they cannot be read.
std::unique_ptr<ImageReader> open_exr(const std::string& path);

}  // namespace quell
