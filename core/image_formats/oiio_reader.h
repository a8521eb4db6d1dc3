// Images by OpenImageIO.
#pragma once

#include "core/sequence/image_reader.h"

#include <memory>
#include <string>

namespace quell {

std::unique_ptr<ImageReader> open_by_oiio(const std::string& path);

}  // namespace quell
