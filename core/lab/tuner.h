// Carries a search for parameters out: runs the graph with what the search tries, and remembers what it gave.
#pragma once

#include "core/lab/trial.h"
#include "core/lab/tuning.h"
#include "core/run/executor.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace quell {

// "alpha=0.1 sigma_depth=2": values of the tuning's parameters, in its order.
std::string parameters_text(const Tuning&, std::span<const double> values);

// Means and the like of the metrics that the expression names, and what it comes to.
struct TunedScore {
  double value = 0;
  std::map<std::string, double> numbers;
};

struct TunedStep {
  std::vector<double> parameters;  // in the order of the tuning's
  TunedScore score;
  bool remembered = false;  // from an earlier run
};

// How numbers came to be.
struct TunedGraph {
  std::string text;         // as a graph file
  std::string fingerprint;  // of it
  std::string plugins;      // node types with versions: its own, those of metrics and of what makes the frames
};

struct TunedResult {
  std::vector<TunedStep> steps;  // in the order in which they were tried
  std::size_t best = 0;          // of the steps
  bool converged = false;
  TunedGraph graph;            // with the best step's parameters, on the first sequence
  TunedScore training_before;  // with the graph's own parameters
  std::optional<TunedScore> held_out_before, held_out_after;
};

struct TunerOptions {
  RunOptions run;
  std::filesystem::path journal;                // file of what was tried, kept after every step
  std::function<void(const TunedStep&)> tried;  // for people
};

class Tuner {
 public:
  Tuner(const Tuning& tuning, Laboratory& lab, const TunerOptions& options)
      : tuning_(tuning), lab_(lab), options_(options) {}

  // Loads the graph as it is and with each parameter at both ends of its range, so that what is wrong with parameters,
  // metrics and sequences is found before anything is run; that goes to the diagnostics. Finds where to start.
  bool check();
  // Throws Error; what was tried before is in the journal, and is taken from there by the next run.
  TunedResult run();

  // The graph's edits with these parameters: {"set": {"alpha": 0.1}}, over those that the tuning makes itself.
  Json edits(const std::vector<double>& parameters) const;

 private:
  std::vector<StudyVariant> ends() const;
  void start_from(const Trial&);
  // `whose` begins what is said of numbers that come to none.
  TunedScore score(const Study&, const Json& edits, const std::string& whose);
  TunedGraph graph(const Json& edits);
  void read_journal();
  void write_journal() const;

  const Tuning& tuning_;
  Laboratory& lab_;
  const TunerOptions& options_;
  std::vector<SearchRange> ranges_;
  std::string key_;  // of all that decides the scores
  std::map<std::vector<double>, TunedScore> known_;
  std::vector<std::vector<double>> order_;  // of what is known
};

}  // namespace quell
