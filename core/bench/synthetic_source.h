// Frames made in memory for timing a graph at any size: a patchwork of surfaces under a moving camera, with the noise
// of one sample a pixel.
#pragma once

#include "core/graph/graph.h"
#include "core/image/image.h"
#include "core/sequence/frame_source.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace quell {

// An image of this type by the conventions of <quell/types.h>. `take` is what differs from frame to frame: noise, and
// nothing of the surfaces, which all images of one size show alike. What a type without fixed channels gets is 8.
Image synthetic_image(int type, int width, int height, int take);

// What surfaces emit: nothing, but for a lamp. All radiance holds it.
Image synthetic_emission(int width, int height);

// Gives a graph all of its inputs, the optional ones too; an input called emission gets that. Two takes alternate, so
// that history meets new noise; reading a frame copies it.
class SyntheticSource : public FrameSource {
 public:
  SyntheticSource(const Graph&, int width, int height, int frames);

  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return frame == frames_[0]; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override;
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override;
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  std::vector<std::int64_t> frames_;
  std::map<std::string, int> roles_;
  std::map<std::string, std::vector<Image>> takes_;  // one where the takes are alike
};

}  // namespace quell
