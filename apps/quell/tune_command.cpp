// quell tune: parameters of a graph that make an expression of metrics small.
#include "apps/quell/command.h"
#include "apps/quell/interrupt.h"
#include "apps/quell/options.h"

#include "core/graph/write.h"
#include "core/lab/edits.h"
#include "core/lab/folder_lock.h"
#include "core/lab/tuner.h"
#include "core/report/shell.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdio>

namespace quell {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

struct TuneArguments {
  PluginOptions plugins;
  std::string tuning, output = "tuning", references;
  bool resume = false, restart = false, check = false, quiet = false;
  int threads = 0;
  SimdOption simd;
};

std::string step_text(const Tuning& tuning, const TunedStep& step) {
  return fmt::format("{:.6g}  {}{}", step.score.value, parameters_text(tuning, step.parameters),
                     step.remembered ? "  (known)" : "");
}

// A graph with what was found: a variant of an installed graph, and of a file's, which may lie anywhere, the whole.
std::string variant_text(const Tuning& tuning, const Json& edits, double before, double after, Commander& commander) {
  const auto& graph = tuning.training.variants.front().graph;
  ordered_json j = {{"quell", 1}, {"base", graph}};
  auto forms = ordered_json::parse(edits_text(edits));
  if (graph.find('/') != graph.npos || graph.ends_with(".json")) {
    GraphRequest request;
    request.graph = graph;
    request.graphs = commander.locations().graphs;
    request.laid_over = edits;
    const auto loaded = load_graph(request, commander.registry(), commander.diagnostics());
    if (!loaded) throw Error(commander.diagnostics().exit(), commander.diagnostics().format());
    j = ordered_json::parse(write_graph(*loaded, request.graphs).text);
    forms = ordered_json::object();
  }
  j["name"] = tuning.name;
  j["about"] = fmt::format("Tuned for {}: {:.6g} in place of {:.6g} on the sequences that it was tuned on.",
                           tuning.minimise->text(), after, before);
  for (auto it = forms.begin(); it != forms.end(); ++it) j[it.key()] = it.value();
  return j.dump(2) + "\n";
}

ordered_json score_json(const TunedScore& score) { return {{"value", score.value}, {"numbers", score.numbers}}; }

std::string result_json(const Tuning& tuning, const TunedResult& r) {
  ordered_json j = {{"quell_tuning", 1}, {"name", tuning.name}, {"minimise", tuning.minimise->text()}};
  auto& parameters = j["best"] = ordered_json::object();
  for (std::size_t i = 0; i < tuning.parameters.size(); ++i) {
    const double value = r.steps[r.best].parameters[i];
    auto& written = parameters[tuning.parameters[i].name];
    tuning.parameters[i].range.integer ? written = std::int64_t(value) : written = value;
  }
  j["converged"] = r.converged;
  j["quell"] = QUELL_VERSION, j["simd"] = simd_in_use(), j["plugins"] = r.graph.plugins;
  j["command"] = shell_text(command_line());
  j["fingerprint"] = r.graph.fingerprint, j["graph"] = ordered_json::parse(r.graph.text);
  j["training"] = {{"before", score_json(r.training_before)}, {"after", score_json(r.steps[r.best].score)}};
  if (r.held_out_before)
    j["held_out"] = {{"before", score_json(*r.held_out_before)}, {"after", score_json(*r.held_out_after)}};
  auto& steps = j["steps"] = ordered_json::array();
  for (const auto& s : r.steps)
    steps.push_back({{"parameters", s.parameters}, {"value", s.score.value}, {"numbers", s.score.numbers}});
  return j.dump(1) + "\n";
}

void print_row(const char* what, const TunedScore& before, const TunedScore& after) {
  fmt::print("{:<10} {:>12.6g} -> {:.6g}\n", what, before.value, after.value);
  for (const auto& [name, number] : before.numbers)
    fmt::print("  {:<24} {:>12.6g} -> {:.6g}\n", name, number, after.numbers.at(name));
}

int run(const TuneArguments& a) {
  const auto& cancel = watch_interrupts();
  a.simd.apply();
  Commander commander(a.plugins);
  const auto tuning = load_tuning(a.tuning, commander.locations().graphs, commander.diagnostics());
  if (!tuning) return commander.report();
  const fs::path folder = a.output;
  auto lab =
      commander.laboratory(a.references.empty() ? folder / "references" : fs::path(a.references), a.threads, &cancel);
  TunerOptions options;
  options.run.threads = a.threads;
  options.run.cancel = &cancel;
  options.journal = folder / "journal.json";
  options.tried = [&](const TunedStep& step) {
    if (!a.quiet) fmt::print(stderr, "{}\n", step_text(*tuning, step));
  };
  Tuner tuner(*tuning, lab, options);
  const bool good = tuner.check();
  if (const int code = commander.report(); code || !good) return code ? code : int(Exit::usage);
  if (a.check) return 0;

  const FolderLock lock(folder);
  std::error_code error;
  if (fs::exists(options.journal, error) && !a.resume) {
    if (!a.restart)
      throw Error(Exit::usage, fmt::format("{} holds the work of an earlier run\n  --resume goes on with it: what was "
                                           "tried is not computed again; --restart begins anew",
                                           a.output));
    fs::remove(options.journal, error);
  }
  check_writable((folder / "variant.json").string());
  TunedResult result;
  try {
    result = tuner.run();
  } catch (const Error& e) {
    if (e.exit() != Exit::interrupted) throw;
    throw Error(Exit::interrupted,
                fmt::format("interrupted; quell tune {} -o {} --resume goes on", a.tuning, a.output));
  }
  const auto& best = result.steps[result.best];
  write_file(
      (folder / "variant.json").string(),
      variant_text(*tuning, tuner.edits(best.parameters), result.training_before.value, best.score.value, commander));
  write_file((folder / "tuning.json").string(), result_json(*tuning, result));
  fmt::print("{} steps, {}\n", result.steps.size(), result.converged ? "converged" : "no more were allowed");
  print_row("training", result.training_before, best.score);
  if (result.held_out_before) print_row("held out", *result.held_out_before, *result.held_out_after);
  fmt::print("{}\n", (folder / "variant.json").string());
  return 0;
}

}  // namespace

void add_tune(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("tune", "Searches for parameters that make an expression of metrics small.");
  auto a = std::make_shared<TuneArguments>();
  sub->add_option("tuning", a->tuning, "A tuning file.")->required()->type_name("TUNING");
  sub->add_option("-o,--output", a->output, "Folder for variant.json, tuning.json and the journal.")
      ->type_name("DIR")
      ->check(not_empty())
      ->capture_default_str();
  add_resume(*sub, a->resume, "Goes on with what the folder holds.", a->restart);
  sub->add_flag("--check", a->check, "Checks the file, its graph, metrics and sequences, and runs nothing.");
  sub->add_option("--references", a->references,
                  "Folder where references are kept that a source node makes. Default: DIR/references.")
      ->type_name("DIR")
      ->check(not_empty());
  sub->add_option("--threads", a->threads, "Threads; 0: every core that affinity and quotas grant.")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  a->simd.add_to(*sub);
  sub->add_flag("-q,--quiet", a->quiet, "Prints no steps.");
  a->plugins.add_to(*sub);
  sub->footer(
      "The search is Nelder and Mead's simplex, held to the ranges: deterministic, and resumable because the same "
      "points\n"
      "are tried in the same order. Results on held-out sequences are reported beside those that were tuned on.\n"
      "Example:\n"
      "  quell tune tune_svgf.json -o tuned && quell run tuned/variant.json shot.json");
  sub->callback([a, &exit] { exit = run(*a); });
}

}  // namespace quell
