// A sequence over and over, for as many frames as a measurement wants. History ends where it starts anew.
#pragma once

#include "core/sequence/frame_source.h"

namespace quell {

class LoopedSource : public FrameSource {
 public:
  // `source` has frames, and outlives this.
  LoopedSource(FrameSource& source, int frames) : source_(source) {
    for (int f = 0; f < frames; ++f) frames_.push_back(f);
  }

  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return of(frame) == of(0) || source_.cut_before(of(frame)); }
  const std::map<std::string, int>& roles() const override { return source_.roles(); }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override {
    return source_.shapes(of(frame), roles);
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    source_.read(of(frame), roles, into);
  }
  std::map<std::string, Repairs> repairs() const override { return source_.repairs(); }

 private:
  std::int64_t of(std::int64_t frame) const { return source_.frames()[std::size_t(frame) % source_.frames().size()]; }

  FrameSource& source_;
  std::vector<std::int64_t> frames_;
};

}  // namespace quell
