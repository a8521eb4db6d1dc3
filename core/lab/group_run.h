// Variants of a study on one sequence with one seed, run as one merged graph in chunks that are kept in a journal.
#pragma once

#include "core/lab/journal.h"
#include "core/lab/merge.h"
#include "core/lab/trial.h"
#include "core/run/executor.h"

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace quell {

// Which images of a sequence are written, and where.
struct StudyImages {
  std::filesystem::path folder;  // of this sequence
  std::set<std::int64_t> frames;
  // By variant of the study: what its images carry, so that each can be made again.
  std::vector<std::map<std::string, std::string>> attributes = {};

  std::string output(const std::string& variant, std::int64_t frame) const;
  std::string map(const std::string& metric, const std::string& variant, std::int64_t frame) const;
  std::string input(std::int64_t frame) const;
  std::string reference(std::int64_t frame) const;
};

// Variants that run together, as indices into the trial's.
class Group {
 public:
  Group(const Study&, const Trial&, std::vector<std::size_t> variants, bool images);

  const Graph& graph() const { return merged_.graph; }
  const std::vector<std::size_t>& variants() const { return variants_; }
  std::vector<std::string> roles() const;

  // Nodes of each variant that no other of the group has, metrics aside.
  std::vector<int> unshared() const;
  // Adds a frame's numbers to the entries, one a variant.
  void take(std::int64_t frame, std::span<const quell_image> outputs, const std::set<std::int64_t>& reference_frames,
            std::span<JournalEntry> entries) const;
  // Writes a frame's images.
  void write(std::int64_t frame, std::span<const quell_image> outputs, const StudyImages&,
             const std::map<std::string, std::string>& metadata) const;
  // Adds what threads spent on each node.
  void charge(std::span<const double> busy, std::span<JournalEntry> entries) const;

 private:
  bool judged_by_reference(std::size_t metric, std::int64_t frame, const std::set<std::int64_t>& with) const;

  const Study* study_;
  const Trial* trial_;
  std::vector<std::size_t> variants_;
  Graph seen_;  // shows what all variants see: input and reference
  Merged merged_;
  std::vector<std::size_t> first_output_;        // of each variant
  std::vector<std::vector<int>> own_, judging_;  // by variant, nodes of the merged graph: its own, and of its metrics
  std::vector<int> users_;                       // of each node
  std::vector<int> looks_back_;                  // by metric: frames that its reference must be there for, less one
};

struct GroupOptions {
  RunOptions run;
  const StudyImages* images = nullptr;  // none are written without
  std::map<std::string, std::string> metadata;
  std::function<void(std::int64_t frame)> done;  // a frame is filtered
};

// Runs what the journal's part lacks; `part` has one entry a variant of the group, and numbers of as many frames for
// each. Finishes it in the journal.
void run_group(const Group&, FrameSource&, const Trial&, JournalPart part, const Journal&, const GroupOptions&);

}  // namespace quell
