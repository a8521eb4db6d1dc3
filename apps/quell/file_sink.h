// A run's outputs to files.
#pragma once

#include "core/graph/graph.h"
#include "core/run/executor.h"
#include "core/run/provenance.h"
#include "core/sequence/frame_pattern.h"
#include "core/sequence/image_writer.h"
#include "core/sequence/sequence.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace quell {

// An output of type value: a number for each frame.
struct ReportedValue {
  std::string name;
  std::vector<std::pair<std::int64_t, float>> frames;
};

// Where each output goes. `wanted` is what -o said: "pattern" for the first output, "name=pattern" for any. The others,
// and taps, are written beside the first under their own names; an output that is a preview, as a .png beside what it
// shows. Throws before anything is written: Error(Exit::usage) for a name that is no output, a file that is neither
// .exr nor .png, a pattern without a frame number (when there are several frames), two outputs to one file and a file
// that the sequence reads; Error(Exit::resources) for a folder that cannot be written to. Outputs of type value go to
// no file: they are kept, to be reported. Each file says how it came to be, in attributes of `provenance`, and as
// quell:output which output it holds and how.
class FileSink : public FrameSink {
 public:
  FileSink(const Graph&, const Sequence&, std::span<const std::int64_t> frames, const std::vector<std::string>& wanted,
           WriteOptions, Provenance&);
  void write(std::int64_t frame, std::span<const quell_image> outputs) override;
  void history_begins(std::int64_t frame) override { provenance_.history_begins(frame); }

  // Patterns, in the order of the graph's outputs but previews; empty for values.
  const std::vector<FramePattern>& patterns() const { return patterns_; }
  // Of the frames written, in their order. Not while a run goes on.
  const std::vector<ReportedValue>& values() const { return values_; }
  // Frames of which all files are written. Not while a run goes on.
  const std::vector<std::int64_t>& written() const { return written_; }

 private:
  std::vector<std::string> choose(const std::vector<std::string>& wanted) const;  // a pattern for each output
  void check_files(const Sequence&, std::span<const std::int64_t> frames) const;

  // Of outputs that are no previews, which stand before those.
  std::vector<int> types_;
  std::vector<std::string> names_;
  std::vector<FramePattern> patterns_;
  std::vector<FramePattern> previews_;
  std::vector<int> shown_;                 // one a preview: what it shows
  std::vector<std::string> output_texts_;  // quell:output of each output, then of each preview
  std::vector<ReportedValue> values_;
  std::vector<std::int64_t> written_;
  WriteOptions options_;
  Provenance& provenance_;
};

}  // namespace quell
