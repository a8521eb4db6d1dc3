// A sequence that a source node makes: each of its outputs is the role of its name.
#pragma once

#include "core/image/image.h"
#include "core/run/workers.h"
#include "core/sequence/frame_source.h"

#include <memory>
#include <set>

namespace quell {

class NodeSource : public FrameSource {
 public:
  // `node` has no required inputs. History ends before each frame of `cuts`, and where a number does not follow the one
  // before. Throws Error(Exit::plugin) when the node refuses its parameters.
  NodeSource(Instance node, std::vector<std::int64_t> frames, std::set<std::int64_t> cuts, int threads,
             const std::atomic<bool>* cancel);
  ~NodeSource() override;

  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t frame) const override;
  bool declared_cut(std::int64_t frame) const override { return cuts_.contains(frame); }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t frame, std::span<const std::string> roles) override;
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override;
  std::map<std::string, Repairs> repairs() const override { return {}; }
  std::string description(const std::filesystem::path& graphs, std::span<const std::string> roles) const override;
  std::map<std::string, std::string> plugins(std::span<const std::string> roles) const override;
  void watch_files(FileWatcher) override;

 private:
  std::size_t output(const std::string& role) const;

  GraphNode node_;
  std::vector<std::int64_t> frames_;
  std::set<std::int64_t> cuts_;
  std::map<std::string, int> roles_;
  std::vector<quell_shape> shapes_;  // of each output
  Workers workers_;
  std::unique_ptr<void, void (*)(void*)> resource_;
  std::vector<Image> unasked_;  // where outputs go that nobody reads
  FileWatcher watcher_;
  std::map<std::string, std::string> hashes_;  // of files that parameters name, by "source.parameter"
};

}  // namespace quell
