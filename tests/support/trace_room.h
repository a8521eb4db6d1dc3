// Frames of the built-in room, traced at any quality: noisy ones, guides and references.
#pragma once

#include "core/image/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace quell::test {

struct RoomFrame {
  std::int64_t frame;
  int spp, seed;
  int width, height;
};

// Outputs of the path tracer for one frame.
std::vector<Image> trace_room(const RoomFrame&, const std::vector<std::string>& roles);

}  // namespace quell::test
