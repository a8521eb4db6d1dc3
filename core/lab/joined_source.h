// Several sources of frames as one: pictures, their reference and the features of a sequence.
#pragma once

#include "core/sequence/frame_source.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace quell {

class JoinedSource : public FrameSource {
 public:
  struct Part {
    std::string label;  // in messages: "--reference truth.####.exr"
    std::unique_ptr<FrameSource> source;
    std::map<std::string, std::string> roles;  // as they are called here, and what the source calls them
    bool still = false;                        // one frame, which serves all
    // Frames that it has, where it need not have all: the others read as missing. Empty: it must have all.
    std::vector<std::int64_t> sparse = {};
  };

  // Frames and cuts are those of the first part that moves. Throws Error(Exit::input) when another part lacks one of
  // them, and Error(Exit::usage) when two parts give one role.
  explicit JoinedSource(std::vector<Part> parts);

  const std::vector<std::int64_t>& frames() const override { return lead().frames(); }
  bool cut_before(std::int64_t frame) const override { return lead().cut_before(frame); }
  bool declared_cut(std::int64_t frame) const override { return lead().declared_cut(frame); }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override;
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override;
  void refuse_non_finite(std::span<const std::string> roles) override;
  std::map<std::string, Repairs> repairs() const override;
  // Where several parts or other names are needed, {"quell_joined": 1, "parts": [{"roles": {here: there}, "still":
  // true, "frames": "0,7", "sequence": {…}}]}, the first that moves always among them; "frames" are those of a part
  // that need not have all.
  std::string description(const std::filesystem::path& graphs, std::span<const std::string> roles) const override;
  std::map<std::string, std::string> plugins(std::span<const std::string> roles) const override;
  void watch_files(FileWatcher) override;

  // Whether the role's source has this frame, and its images are not those of a missing one.
  bool has(std::int64_t frame, const std::string& role) const;

 private:
  // Calls use(part, which of `roles` it gives and under which names of its own) for each that gives some, and for the
  // first that moves.
  template <class Use>
  void each_used(std::span<const std::string> roles, Use use) const;
  // Names in FileRead: of the first part that moves its own, of the others behind their roles, "reference: b.exr".
  std::string told_name(std::size_t part, const FileRead&) const;
  const FrameSource& lead() const { return *parts_[lead_].source; }
  static bool has(const Part&, std::int64_t frame);
  // Calls use(part, its own names of the roles, their places in `roles`) for each part that gives some.
  template <class Use>
  void split(std::span<const std::string> roles, Use use);

  std::vector<Part> parts_;
  std::size_t lead_ = 0;
  std::map<std::string, int> roles_;
  std::map<std::string, std::size_t> part_of_;
  std::int64_t reading_ = 0;  // this frame; of a still part its files are told of for each frame that it serves
};

}  // namespace quell
