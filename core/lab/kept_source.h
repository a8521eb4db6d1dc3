// A source whose images are kept on disk: what takes minutes to make is made once.
#pragma once

#include "core/run/node_source.h"
#include "core/sequence/frame_source.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace quell {

// Gives one role of another source, bit for bit, from 32-bit files in a folder, where they are; else makes and writes
// them. A file is never half written, so a run that was killed leaves nothing wrong behind. `made_from` are the files,
// with their hashes, that the source makes every frame from: of a kept one they are told of too.
class KeptSource : public FrameSource {
 public:
  KeptSource(std::unique_ptr<FrameSource> source, std::string role, std::filesystem::path folder,
             std::map<std::string, std::string> made_from);

  const std::vector<std::int64_t>& frames() const override { return source_->frames(); }
  bool cut_before(std::int64_t frame) const override { return source_->cut_before(frame); }
  bool declared_cut(std::int64_t frame) const override { return source_->declared_cut(frame); }
  const std::map<std::string, int>& roles() const override { return source_->roles(); }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override {
    return source_->shapes(frame, roles);
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override;
  std::map<std::string, Repairs> repairs() const override { return source_->repairs(); }
  std::string description(const std::filesystem::path& graphs, std::span<const std::string> roles) const override {
    return source_->description(graphs, roles);
  }
  std::map<std::string, std::string> plugins(std::span<const std::string> roles) const override {
    return source_->plugins(roles);
  }
  void watch_files(FileWatcher) override;

 private:
  // Whether there is a kept image of this size that can be read.
  bool read_kept(const std::string& path, const quell_image& into) const;
  bool read_whole(const std::string& path, const quell_image& into) const;

  std::unique_ptr<FrameSource> source_;
  std::string role_;
  std::filesystem::path folder_;
  std::map<std::string, std::string> made_from_;
  FileWatcher watcher_;
};

// All that decides what a node without inputs makes, as text: its type, version and parameters. Files that they name
// count by what they hold, wherever they lie.
std::string node_identity(Instance);

// The colour that a node makes, kept in a folder of its own among `references`; "" for none, where it is made anew.
// Every program that keeps references there finds what others have made.
std::unique_ptr<FrameSource> keep_reference(std::unique_ptr<NodeSource>, const Instance&,
                                            const std::filesystem::path& references);

}  // namespace quell
