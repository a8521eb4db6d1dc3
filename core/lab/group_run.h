// Variants of a study on one sequence with one seed, run as one merged graph in chunks that are kept in a journal.
#pragma once

#include "core/lab/journal.h"
#include "core/lab/merge.h"
#include "core/lab/study_images.h"
#include "core/lab/trial.h"
#include "core/run/executor.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace quell {

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
  void take(std::int64_t frame, std::span<const quell_image> outputs, std::span<JournalEntry> entries) const;
  // What is to be seen in the outputs.
  std::vector<ShownOutput> shown() const;
  // Adds what threads spent on each node.
  void charge(std::span<const double> busy, std::span<JournalEntry> entries) const;

 private:
  const Study* study_;
  const Trial* trial_;
  std::vector<std::size_t> variants_;
  Graph seen_;  // shows what all variants see: input and reference
  Merged merged_;
  std::vector<std::size_t> first_output_;        // of each variant
  std::vector<std::vector<int>> own_, judging_;  // by variant, nodes of the merged graph: its own, and of its metrics
  std::vector<int> users_;                       // of each node
};

struct GroupOptions {
  RunOptions run;
  StudyImageWriter* images = nullptr;            // none are written without
  FileLog* log = nullptr;                        // of the source; kept in the journal
  std::function<void(std::int64_t frame)> done;  // a frame is filtered
};

// Runs what the journal's part lacks; `part` has one entry a variant of the group, and numbers of as many frames for
// each. Finishes it in the journal.
void run_group(const Group&, FrameSource&, JournalPart part, const Journal&, const GroupOptions&);

}  // namespace quell
