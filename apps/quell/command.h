// What the subcommands share: options that several of them take, opening graphs and sequences, and how they end.
#pragma once

#include "apps/quell/locations.h"

#include "core/graph/load.h"
#include "core/lab/trial.h"
#include "core/plugin/registry.h"
#include "core/report/diagnostics.h"
#include "core/report/error.h"
#include "core/sequence/file_sequence.h"
#include "core/sequence/sequence.h"

#include <CLI/CLI.hpp>

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quell {

// --plugins, and what is found with it.
struct PluginOptions {
  std::vector<std::string> folders;
  void add_to(CLI::App&);
};

// GRAPH and its edits.
struct GraphOptions {
  std::string graph;
  std::vector<std::string> set, swap, wire, bypass, tap;
  void add_to(CLI::App&);
};

// SEQUENCE and how it is read.
struct SequenceOptions {
  std::string sequence;
  std::string frames, root, missing = "error";
  std::vector<std::string> source;  // parameters of a source node
  bool offers_missing = false;      // --missing is an option of this command
  void add_to(CLI::App&, bool required);
};

class Commander {
 public:
  explicit Commander(const PluginOptions& plugins);

  Registry& registry() { return registry_; }
  const Locations& locations() const { return locations_; }
  Diagnostics& diagnostics() { return diagnostics_; }

  std::optional<Sequence> load(const SequenceOptions&);
  std::optional<Sequence> load(SequenceRequest);
  std::optional<Graph> load(const GraphOptions&, const Sequence*, GraphInfo* info = nullptr);
  std::optional<Graph> load(GraphRequest, const Sequence*, GraphInfo* info = nullptr);
  // Opens the frames for what the graph reads.
  std::unique_ptr<FrameSource> open(const Sequence&, const SequenceOptions&, const std::vector<std::string>& roles,
                                    int threads, const std::atomic<bool>* cancel);
  // What studies, suites and searches run with; `references` is where those are kept that a node makes, "" for nowhere.
  Laboratory laboratory(std::filesystem::path references, int threads, const std::atomic<bool>* cancel);
  // Prints what was collected to stderr and gives the exit code of the worst of it. Plugins that were passed over
  // because they would not load are warned about.
  int report();

 private:
  std::optional<std::string> sequence_path(const SequenceOptions&);

  Locations locations_;
  Registry registry_;
  Diagnostics diagnostics_;
};

// Each adds its subcommand, which sets `exit` when it has run.
void add_run(CLI::App&, int& exit);
void add_rerun(CLI::App&, int& exit);
void add_check(CLI::App&, int& exit);
void add_nodes(CLI::App&, int& exit);
void add_metrics(CLI::App&, int& exit);
void add_graph(CLI::App&, int& exit);
void add_plan(CLI::App&, int& exit);
void add_bench(CLI::App&, int& exit);
void add_ablate(CLI::App&, int& exit);
void add_compare(CLI::App&, int& exit);
void add_test(CLI::App&, int& exit);
void add_tune(CLI::App&, int& exit);

}  // namespace quell
