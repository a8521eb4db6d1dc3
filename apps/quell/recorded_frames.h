// The frames that a picture was made from, opened again from its quell:sequence.
#pragma once

#include "apps/quell/command.h"
#include "apps/quell/recorded.h"

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quell {

class RecordedFrames {
 public:
  // `root`: where the files are now, "" for where they were. What is wrong goes to the commander's diagnostics, and
  // nothing is returned then. Throws Error.
  static std::optional<RecordedFrames> load(Commander&, const std::string& picture, const Recorded&,
                                            const std::string& root);

  // What a graph may read.
  std::map<std::string, int> roles() const;
  // Whether this file is one of a frame between these.
  bool reads(const std::string& path, std::int64_t first, std::int64_t last) const;
  std::unique_ptr<FrameSource> open(Commander&, const std::vector<std::string>& roles, int threads,
                                    const std::atomic<bool>* cancel) const;

 private:
  // As JoinedSource::Part.
  struct Part {
    Sequence sequence;
    std::map<std::string, std::string> roles;
    bool still = false;
    std::vector<std::int64_t> sparse;
  };
  bool load_part(Commander&, SequenceRequest, Part);
  std::unique_ptr<FrameSource> open(Commander&, const Part&, const std::vector<std::string>& roles, int threads,
                                    const std::atomic<bool>* cancel) const;

  std::vector<Part> parts_;
  std::map<std::string, int> roles_;
  bool joined_ = false;  // else one part, all of whose roles keep their names
  std::string missing_;
  bool moved_ = false;  // by `root`
};

}  // namespace quell
