// Runs a study: every variant on every sequence with every seed, shared work once, and what it finished kept.
#pragma once

#include "core/lab/group_run.h"
#include "core/lab/results.h"
#include "core/lab/trial.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace quell {

enum class WrittenImages { few, all };  // few: the first frame behind the warm-up, a middle one and the last

struct AblationOptions {
  std::filesystem::path folder;  // for results
  RunOptions run;                // threads, max_memory, cancel
  WrittenImages images = WrittenImages::few;
  std::vector<std::string> command;
  std::string version, simd;
  std::function<void(const Progress&)> progress;
  std::function<void(const std::string&)> say;  // a line for people
};

// Seconds that threads spent a frame.
struct VariantTimes {
  // On the variant's nodes, as if it had run alone: by sequence the median over frames and seeds, which bears a machine
  // that was busy now and then; and their mean, each sequence counted by its frames.
  std::vector<double> own_of;
  double own = 0;
  double judged = 0;  // on the nodes of its metrics, the mean
};

struct Ablation {
  Results results;
  std::vector<VariantTimes> times;              // by variant, over all sequences and seeds
  std::size_t merged_nodes = 0, all_nodes = 0;  // of the first sequence: of the merged graph, and of all graphs
  double spent = 0, alone = 0;                  // seconds of threads, and what separate runs would have taken
};

// Checks a study on all its sequences. What is wrong goes to the diagnostics; nothing is returned then.
std::optional<std::vector<Trial>> load_trials(const Study&, bool maps, Laboratory&);

// Goes on from what the journal in the folder holds. Throws Error: what was finished before stays in the journal.
Ablation run_study(const Study&, const std::vector<Trial>&, Laboratory&, const AblationOptions&);

// Graph files of all variants, to be run by themselves: variants/NAME.json. Throws Error.
void write_variants(const Study&, const Trial&, const Laboratory&, const std::filesystem::path& folder);

// timings.json.
std::string timings_json(const Ablation&, int threads);

}  // namespace quell
