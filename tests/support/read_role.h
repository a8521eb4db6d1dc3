// One image of a source.
#pragma once

#include "core/image/image.h"
#include "core/sequence/frame_source.h"

#include <string>
#include <vector>

namespace quell::test {

inline Image read_role(FrameSource& source, std::int64_t frame, const std::string& role) {
  const std::vector<std::string> roles = {role};
  Image image(source.shapes(frame, roles).at(0));
  const quell_image view = image.view();
  source.read(frame, roles, {&view, 1});
  return image;
}

}  // namespace quell::test
