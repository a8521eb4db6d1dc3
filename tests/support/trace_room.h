// Frames of the built-in scenes, traced at any quality: noisy ones, guides and references.
#pragma once

#include "core/image/image.h"
#include "core/sequence/frame_source.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace quell::test {

struct Tracing {
  int spp, seed;
  int width, height;
};

// Every output of the path tracer is a role. Scenes are those of graphs/scenes.
std::unique_ptr<FrameSource> trace_scene(const std::string& scene, const std::vector<std::int64_t>& frames,
                                         const std::set<std::int64_t>& cuts, const Tracing&);

struct RoomFrame {
  std::int64_t frame;
  int spp, seed;
  int width, height;
};

// Outputs of the path tracer for one frame of the room.
std::vector<Image> trace_room(const RoomFrame&, const std::vector<std::string>& roles);

}  // namespace quell::test
