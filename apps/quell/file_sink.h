// A run's outputs to files.
#pragma once

#include "core/graph/graph.h"
#include "core/run/executor.h"
#include "core/sequence/frame_pattern.h"
#include "core/sequence/image_writer.h"

#include <string>
#include <vector>

namespace quell {

// Where each output goes. `wanted` is what -o said: "pattern" for the first output, "name=pattern" for any. The others,
// and taps, are written beside the first under their own names. `suffix` (".png") in place of the pattern's own
// extension makes previews. Throws Error(Exit::usage) for a name that is no output, a pattern without a frame number
// (when there are several frames) and two outputs to one file.
class FileSink : public FrameSink {
 public:
  FileSink(const Graph&, const std::vector<std::string>& wanted, bool several_frames, bool preview, WriteOptions);
  void write(std::int64_t frame, std::span<const quell_image> outputs) override;

  // Patterns, in the order of the graph's outputs.
  const std::vector<FramePattern>& patterns() const { return patterns_; }

 private:
  std::vector<int> types_;
  std::vector<FramePattern> patterns_, previews_;
  WriteOptions options_;
};

}  // namespace quell
