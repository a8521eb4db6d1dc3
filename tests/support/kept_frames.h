// Frames in memory: read once, run over by many graphs.
#pragma once

#include "core/image/image.h"
#include "core/sequence/frame_source.h"

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace quell::test {

class KeptFrames : public FrameSource {
 public:
  // All frames, in these roles; without any, in all.
  explicit KeptFrames(FrameSource&, std::vector<std::string> roles = {});

  const Image& image(std::int64_t frame, const std::string& role) const { return images_.at(frame).at(role); }
  // One more role (quell_type `type`), made of each frame.
  void add(const std::string& role, int type, const std::function<Image(std::int64_t frame)>& make);

  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return cuts_.contains(frame); }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override;
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override;
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  std::vector<std::int64_t> frames_;
  std::set<std::int64_t> cuts_;
  std::map<std::string, int> roles_;
  std::map<std::int64_t, std::map<std::string, Image>> images_;
};

}  // namespace quell::test
