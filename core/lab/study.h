// A study: a graph, edits of it to be tried, sequences to try them on and metrics to judge them by. Parsed from its
// file, its sweeps and automatic ablations written out as variants.
#pragma once

#include "core/json/json.h"
#include "core/report/diagnostics.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace quell {

struct StudySequence {
  std::string name;     // in results and of folders
  std::string written;  // as the study names it: "room", "shots/a.json"
  std::string path;     // what load_sequence takes
  std::optional<std::string> frames, root;
  std::vector<JsonMember> source, reference;  // parameters of the nodes that make frames and reference
  TextPosition position;
  std::string where;  // "sequences[0]"
};

struct StudyVariant {
  std::string name;  // in results and of files
  std::string about;
  std::string graph;      // what load_graph takes
  Json edits;             // short forms over it: set, swap, wire, bypass
  bool baseline = false;  // another graph, to compare with
  TextPosition position;
  std::string where;  // "variants.no_variance", "sweeps.alpha"
};

struct StudyMetric {
  std::string name;  // what load_metric takes
  TextPosition position;
  std::string where;
};

struct StudySeeds {
  std::string parameter;  // of the node that makes the frames
  std::vector<int> values;
  TextPosition position;
};

inline constexpr int kWarmUp = 4;  // where a file says nothing of it

struct Study {
  std::string file, name, about;
  std::string output;                    // of the graphs, to be judged; "" for the first
  std::vector<StudySequence> sequences;  // at least one
  std::vector<StudyVariant> variants;    // the graph itself, called "base", first
  std::vector<StudyMetric> metrics;      // at least one
  std::optional<StudySeeds> seeds;
  int warm_up = kWarmUp;  // frames at the beginning that enter no summary
};

// More is a mistake, and is refused before it takes anybody's time.
inline constexpr std::size_t kMaxVariants = 1000;
inline constexpr std::size_t kMaxListed = 1000;  // of sequences, metrics, seeds, tests, their conditions and images

struct StudyRequest {
  std::string path;              // a file, or an installed study when it has neither a slash nor ".json"
  std::filesystem::path graphs;  // folder of installed graphs; studies and sequences are folders in it
};

// All mistakes of the file together; what its names mean to graphs, metrics and sequences is for those to say.
std::optional<Study> load_study(const StudyRequest&, Diagnostics&);

// A part of another file that is a study of one graph: a test of a suite, a tuning.
struct StudyPart {
  const Json& json;             // has "graph", and perhaps "output", "warm_up" and edits of the graph
  std::string where;            // "tests.svgf"; "" for the file itself
  std::string name;             // of the one variant
  const Json& sequences;        // a list of them, or one
  std::string sequences_where;  // "train"
  std::vector<StudyMetric> metrics;
};

// The same of such a part; names of files are relative to the folder of `file`.
std::optional<Study> parse_study(const StudyPart&, const std::string& file, const std::filesystem::path& graphs,
                                 Diagnostics&);

}  // namespace quell
