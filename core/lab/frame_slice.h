// Some of the frames of a source.
#pragma once

#include "core/sequence/frame_source.h"

#include <cstddef>
#include <vector>

namespace quell {

// The same frames, from number `first` of the source's up to number `end`.
class FrameSlice : public FrameSource {
 public:
  FrameSlice(FrameSource& source, std::size_t first, std::size_t end)
      : source_(source),
        frames_(source.frames().begin() + std::ptrdiff_t(first), source.frames().begin() + std::ptrdiff_t(end)) {}
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return frame == frames_[0] || source_.cut_before(frame); }
  bool declared_cut(std::int64_t frame) const override { return source_.declared_cut(frame); }
  const std::map<std::string, int>& roles() const override { return source_.roles(); }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override {
    return source_.shapes(frame, roles);
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    source_.read(frame, roles, into);
  }
  std::map<std::string, Repairs> repairs() const override { return source_.repairs(); }

 private:
  FrameSource& source_;
  std::vector<std::int64_t> frames_;
};

}  // namespace quell
