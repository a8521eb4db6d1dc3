// Images as a renderer would give them: one for each type, by the conventions of <quell/types.h>, deterministic.
#pragma once

#include "core/image/image.h"

#include <cstdint>

namespace quell::test {

// Shape of an input of this type in an image of width × height: tables and values have their own.
quell_shape typical_shape(int type, int width, int height);

// Has what real frames have: misses, fireflies, black pixels, albedo above 1, motion that leaves the image. All motion
// of one size is the same, and `taps` are those of that motion.
Image typical_input(int type, int width, int height, std::uint32_t seed);

// What the type reads as when history is missing.
Image missing_input(int type, int width, int height);

}  // namespace quell::test
