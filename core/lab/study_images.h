// Images that a study writes of one sequence: which, where, and what they say of how they were made.
#pragma once

#include "core/lab/results.h"
#include "core/lab/study.h"
#include "core/lab/trial.h"
#include "core/run/provenance.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace quell {

struct StudyImages {
  std::filesystem::path folder;  // of this sequence
  std::set<std::int64_t> frames;

  std::string output(const std::string& variant, std::int64_t frame) const;
  std::string map(const std::string& metric, const std::string& variant, std::int64_t frame) const;
  std::string input(std::int64_t frame) const;
  std::string reference(std::int64_t frame) const;
  // Of sequence number `sequence` of the results, with files relative to their folder.
  std::vector<ResultImage> list(const Study&, const Trial&, std::size_t sequence,
                                const std::filesystem::path& results) const;
};

// What is to be seen in an output of a merged graph.
struct ShownOutput {
  enum class Kind { output, map, input, reference };
  Kind kind;
  std::size_t output;       // of the merged graph
  std::size_t variant = 0;  // of the study: of an output or map
  std::size_t metric = 0;   // of a map
};

// Writes them as frames come by. Each can be made again by `quell rerun`.
class StudyImageWriter {
 public:
  struct Made {
    const FrameSource& source;
    const FileLog& log;
    Provenance::Run run;
    Texts texts;  // that all carry
  };
  StudyImageWriter(const Study&, const Trial&, const StudyImages&, std::vector<ShownOutput>, const Made&);

  // As FrameSink has them; a frame that an earlier process wrote passes without outputs.
  void history_begins(std::int64_t frame);
  void write(std::int64_t frame, std::span<const quell_image> outputs);
  void pass(std::int64_t frame) { write(frame, {}); }

 private:
  struct Image {
    ShownOutput shown;
    Provenance provenance;
    Texts texts;  // besides those
  };
  std::string path_of(const ShownOutput&, std::int64_t frame) const;

  const Study* study_;
  const Trial* trial_;
  const StudyImages* images_;
  std::vector<Image> all_;
};

}  // namespace quell
