// An image file's channels as an image.
#pragma once

#include "core/image/image.h"

#include <string>
#include <vector>

namespace quell::test {

// In this order; what the file does not hold is `before`. `id`: as whole numbers.
Image read_channels(const std::string& path, const std::vector<std::string>& names, float before = -7.0f,
                    bool id = false);

}  // namespace quell::test
