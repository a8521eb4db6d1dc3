// A sequence whose truth is known: surfaces that face the camera, each of one light, seen through the noise of one
// sample a pixel.
#pragma once

#include "core/image/image.h"
#include "core/sequence/frame_source.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace quell::test {

struct StagePixel {
  float light = 1;      // that arrives
  float albedo = 0.5f;  // divides it, where there is any; what has none shows the light itself, as glass does
  float depth = 5;
  float dx = 0, dy = 0;  // motion, pixels, previous - current
  float noise = 1;       // relative deviation of the light
};

class Stage : public FrameSource {
 public:
  using Play = std::function<StagePixel(std::int64_t frame, int x, int y)>;
  Stage(int width, int height, int frames, Play, std::int64_t cut = -1);

  // Radiance without noise.
  float truth(std::int64_t frame, int x, int y) const;

  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t f) const override { return f == 0 || f == cut_; }
  bool declared_cut(std::int64_t f) const override { return f == cut_; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override;
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override;
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  int width_, height_;
  std::int64_t cut_;
  Play play_;
  std::vector<std::int64_t> frames_;
  std::map<std::string, int> roles_;
};

}  // namespace quell::test
