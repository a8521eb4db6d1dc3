// A sequence in memory that any graph runs over, and references that say how good what it makes of it is.
#pragma once

#include "core/graph/variant.h"
#include "tests/support/kept_frames.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace quell::test {

// Means over the frames: of flicker over all that have a past, of the others over those that have a reference.
struct Quality {
  double psnr = 0, relative_error = 0, brightness_error = 0, flicker = 0;
};

struct ReferenceHalves {
  Image a, b;
};

using Pictures = std::map<std::int64_t, Image>;  // by frame

class JudgedFrames {
 public:
  // The frames need the roles motion and id, which flicker is measured along.
  JudgedFrames(KeptFrames frames, std::map<std::int64_t, ReferenceHalves> references)
      : frames_(std::move(frames)), references_(std::move(references)) {}

  KeptFrames& frames() { return frames_; }
  // What an installed graph gives as `color`.
  Pictures run(const std::string& graph, std::vector<Edit> edits = {});
  Quality judge(const Pictures&) const;

 private:
  KeptFrames frames_;
  std::map<std::int64_t, ReferenceHalves> references_;
};

// A built-in scene at one sample a pixel, with `spp` samples in either half of the reference of the frames `judged`.
JudgedFrames judged_scene(const std::string& scene, const std::vector<std::int64_t>& frames,
                          const std::set<std::int64_t>& cuts, const std::vector<std::int64_t>& judged, int spp,
                          int width, int height);

// The Cycles room, of the data that QUELL_TEST_DATA names, with positions computed from depth and camera.
JudgedFrames judged_cycles_cornell();

}  // namespace quell::test
