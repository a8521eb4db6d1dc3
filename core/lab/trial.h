// A study on one of its sequences: every graph and metric loaded for what that sequence provides.
#pragma once

#include "core/lab/halves.h"
#include "core/lab/metric.h"
#include "core/lab/study.h"
#include "core/sequence/frame_source.h"
#include "core/sequence/sequence.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// What a study is run with.
struct Laboratory {
  Registry& registry;
  Diagnostics& diagnostics;
  std::filesystem::path graphs;      // folder of installed graphs
  std::filesystem::path references;  // folder where references that a node makes are kept; "" for none
  int threads = 0;                   // as RunOptions has it
  const std::atomic<bool>* cancel = nullptr;
};

// A variant with its metrics attached.
struct JudgedGraph {
  struct Outputs {
    int value, pixels, map;  // of a metric; -1: it has none
  };

  Graph plain;                   // the variant itself
  Graph graph;                   // the same with its metrics, whose nodes and outputs stand behind
  int judged;                    // the output that is
  std::vector<Outputs> metrics;  // in the study's order
};

class Trial {
 public:
  // What is wrong goes to the diagnostics, and nothing is returned then. `maps`: metrics give their maps too.
  static std::optional<Trial> load(const Study&, const StudySequence&, bool maps, Laboratory&);

  // Looks for all files of its frames, and for sizes that do not fit. Throws Error.
  void check_frames(Laboratory&) const;

  const StudySequence& declared() const { return *declared_; }
  const Sequence& sequence() const { return sequence_; }
  const std::vector<Metric>& metrics() const { return metrics_; }
  const std::vector<JudgedGraph>& variants() const { return variants_; }
  const std::map<std::string, int>& roles() const { return roles_; }
  // Frames that have a reference.
  const std::set<std::int64_t>& reference_frames() const { return reference_frames_; }
  // Whether all references are there that the metric's number of this frame is made from.
  bool judges(std::size_t metric, std::int64_t frame) const;

  // All that the variants with their metrics read, and colour.
  std::vector<std::string> all_roles() const;
  // The frames for what these roles name; `seed` in place of the sequence's own. Throws Error, or leaves what is wrong
  // with the diagnostics and gives nothing.
  std::unique_ptr<FrameSource> open(const std::vector<std::string>& roles, const std::optional<StudySeeds>& seeds,
                                    std::size_t seed, Laboratory&) const;
  // All that decides what those frames hold, as text: nodes with versions, parameters and the files that they name;
  // of files, names, sizes and times of change.
  std::string identity(const std::optional<StudySeeds>& seeds, std::size_t seed) const;

 private:
  Trial(const Study& study, const StudySequence& declared) : study_(&study), declared_(&declared) {}
  bool load_frames(Laboratory&);
  void look_at_names(Laboratory&) const;
  void look_for_reference();
  bool load_metrics(Laboratory&);
  bool load_variants(bool maps, Laboratory&);
  bool judges_some_frame(Laboratory&) const;
  std::optional<JudgedGraph> judged(const StudyVariant&, bool maps, Laboratory&) const;
  std::unique_ptr<FileSequence> open_files(const std::vector<std::string>& roles, Laboratory&) const;
  Instance with_seed(const std::optional<StudySeeds>& seeds, std::size_t seed) const;

  const Study* study_;
  const StudySequence* declared_;
  Sequence sequence_;
  std::optional<Instance> source_;
  std::map<std::string, Instance> reference_nodes_;  // by role
  std::map<std::string, int> roles_;                 // of the input
  std::set<std::string> references_;                 // roles that can be had, the mean of halves among them
  std::set<std::int64_t> reference_frames_;
  std::vector<Metric> metrics_;
  std::vector<int> looks_back_;  // by metric: frames before one whose references it reads too; -1: it reads none
  std::vector<JudgedGraph> variants_;
};

}  // namespace quell
