// Some frames of a source, side by side.
#pragma once

#include "core/sequence/frame_source.h"

#include <utility>
#include <vector>

namespace quell {

class Excerpt : public FrameSource {
 public:
  // These, which the source has. The source outlives this.
  Excerpt(FrameSource& source, std::vector<std::int64_t> frames) : source_(source), frames_(std::move(frames)) {}
  // Those from `first` to `last`, in the source's order.
  Excerpt(FrameSource& source, std::int64_t first, std::int64_t last) : source_(source) {
    for (const auto frame : source.frames())
      if (frame >= first && frame <= last) frames_.push_back(frame);
  }

  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override { return source_.cut_before(frame); }
  bool declared_cut(std::int64_t frame) const override { return source_.declared_cut(frame); }
  const std::map<std::string, int>& roles() const override { return source_.roles(); }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override {
    return source_.shapes(frame, roles);
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    source_.read(frame, roles, into);
  }
  std::map<std::string, Repairs> repairs() const override { return source_.repairs(); }
  std::string description(const std::filesystem::path& graphs, std::span<const std::string> roles) const override {
    return source_.description(graphs, roles);
  }
  std::map<std::string, std::string> plugins(std::span<const std::string> roles) const override {
    return source_.plugins(roles);
  }
  void watch_files(FileWatcher watcher) override { source_.watch_files(std::move(watcher)); }

 private:
  FrameSource& source_;
  std::vector<std::int64_t> frames_;
};

}  // namespace quell
