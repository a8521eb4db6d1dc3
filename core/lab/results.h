// What a study found: a number for each variant, sequence, seed, frame and metric, and what those come to.
#pragma once

#include "core/lab/summary.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace quell {

struct ResultMetric {
  std::string name, title, unit;
  bool higher_is_better = false;
  std::optional<double> perfect;
};

struct ResultVariant {
  std::string name, about;
  std::string edits;             // as JSON: { "set": { "alpha": 0.1 } }
  std::string graph;             // as a graph file
  std::string fingerprint;       // of its graph
  std::string command;           // that runs it
  int nodes = 0, own_nodes = 0;  // of its graph; and those that it shares with no other variant
  bool baseline = false;
};

struct ResultSequence {
  std::string name, path;
  int width = 0, height = 0;
  std::vector<std::int64_t> frames;
};

struct ResultImage {
  std::string kind;                    // "output", "input", "reference" or "map"
  std::optional<std::size_t> variant;  // of an output or map
  std::size_t sequence = 0;
  std::int64_t frame = 0;
  std::optional<std::size_t> metric;  // of a map
  std::string file;                   // relative to the folder of results
};

// A number of each metric, where the frame has one: in the order of the metrics.
using FrameNumbers = std::vector<std::optional<double>>;

struct Results {
  std::string name, about, version, simd;
  int warm_up = 0;
  std::vector<int> seeds;  // empty: the sequences' own
  std::vector<ResultMetric> metrics;
  std::vector<ResultVariant> variants;
  std::vector<ResultSequence> sequences;
  std::vector<ResultImage> images;
  // By sequence, seed, variant and frame.
  std::vector<std::vector<std::vector<std::vector<FrameNumbers>>>> numbers;

  std::size_t seed_count() const { return seeds.empty() ? 1 : seeds.size(); }
};

// Of all frames behind the warm-up and all seeds that have a number.
struct ResultSummary {
  std::size_t variant;
  std::optional<std::size_t> sequence;  // none: over all
  std::size_t metric;
  Summary summary;
  // How much greater each number is than that of the first variant for the same frame: what frames differ in by
  // themselves drops out.
  Summary difference;
};

// By sequence (all of them last, where there are several), variant and metric.
std::vector<ResultSummary> summaries(const Results&);

// The files: the schema is in docs/ablation.md. Numbers are written so that reading them gives the same bits.
std::string results_json(const Results&);
std::string results_csv(const Results&);

}  // namespace quell
