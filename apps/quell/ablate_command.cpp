// quell ablate: a study, to results, tables and a report.
#include "apps/quell/command.h"
#include "apps/quell/interrupt.h"
#include "apps/quell/options.h"
#include "apps/quell/progress.h"

#include "core/lab/ablation.h"
#include "core/lab/folder_lock.h"
#include "core/lab/study_report.h"
#include "core/lab/tables.h"
#include "core/run/cores.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

namespace quell {

namespace fs = std::filesystem;

namespace {

struct AblateArguments {
  PluginOptions plugins;
  std::string study, output = "ablation", references;
  bool resume = false, restart = false, images = false, maps = false, check = false;
  int threads = 0;
  double max_memory = 0;  // GiB
  SimdOption simd;
  ProgressOption progress;
};

// What an earlier run left is gone on with, or goes, but only when that was asked for.
void look_at_journal(const AblateArguments& a) {
  const fs::path journal = fs::path(a.output) / "journal";
  std::error_code error;
  if (a.resume || !fs::exists(journal, error)) return;
  if (!a.restart)
    throw Error(Exit::usage,
                fmt::format("{} holds the work of an earlier run\n  --resume goes on with it: what has not "
                            "changed is not computed again; --restart begins anew",
                            a.output));
  fs::remove_all(journal, error);
  if (error) throw Error(Exit::resources, fmt::format("{}: {}", journal.string(), error.message()));
}

// Images and variants that results.json lists; none where it cannot be read.
std::set<std::string> listed_files(const fs::path& folder) {
  std::set<std::string> files;
  std::ifstream in(folder / "results.json");
  const auto results = nlohmann::json::parse(in, nullptr, false);
  try {
    for (const auto& image : results.at("images")) files.insert(image.at("file").get<std::string>());
    for (const auto& v : results.at("variants"))
      files.insert(fmt::format("variants/{}.json", v.at("name").get<std::string>()));
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return files;
}

// What earlier results listed and these do not would be taken for theirs.
void remove_old_files(const fs::path& folder, const std::set<std::string>& before) {
  const auto now = listed_files(folder);
  std::error_code error;
  for (const auto& file : before) {
    const auto path = fs::path(file).lexically_normal();
    if (!now.contains(file) && path.is_relative() && *path.begin() != "..") fs::remove(folder / path, error);
  }
}

void print_saving(const Ablation& ablation) {
  if (ablation.alone <= 0) return;
  fmt::print(stderr, "{} nodes of {}, {:.0f} % of the work of separate runs\n", ablation.merged_nodes,
             ablation.all_nodes, 100 * ablation.spent / ablation.alone);
}

int run(const AblateArguments& a) {
  const auto& cancel = watch_interrupts();
  a.simd.apply();
  Commander commander(a.plugins);
  const auto study = load_study({a.study, commander.locations().graphs}, commander.diagnostics());
  if (!study) return commander.report();
  const fs::path folder = a.output;
  auto lab =
      commander.laboratory(a.references.empty() ? folder / "references" : fs::path(a.references), a.threads, &cancel);
  const auto trials = load_trials(*study, a.maps, lab);
  const int code = commander.report();
  if (!trials || code) return code ? code : int(Exit::usage);
  if (a.check) return 0;

  const FolderLock lock(folder);
  look_at_journal(a);
  const auto before = listed_files(folder);
  check_writable((folder / "results.json").string());
  AblationOptions options;
  options.folder = folder;
  options.run.threads = a.threads;
  options.run.max_memory = std::size_t(a.max_memory * 1024 * 1024 * 1024);
  options.run.cancel = &cancel;
  options.images = a.images ? WrittenImages::all : WrittenImages::few;
  options.version = QUELL_VERSION;
  options.simd = simd_in_use();
  options.command = command_line();
  options.say = [&](const std::string& line) {
    if (!a.progress.quiet) fmt::print(stderr, "{}\n", line);
  };
  write_variants(*study, trials->front(), lab, folder / "variants");
  Ablation ablation;
  try {
    ProgressPrinter progress(a.progress.style());
    options.progress = [&](const Progress& p) { progress(p); };
    ablation = run_study(*study, *trials, lab, options);
  } catch (const Error& e) {
    if (e.exit() != Exit::interrupted) throw;
    throw Error(Exit::interrupted,
                fmt::format("interrupted; quell ablate {} -o {} --resume goes on", a.study, a.output));
  }
  Costs cost;
  cost.of_sequence.resize(ablation.results.sequences.size());
  for (const auto& times : ablation.times) {
    cost.all.push_back(times.own * 1e3);
    for (std::size_t s = 0; s < times.own_of.size(); ++s) cost.of_sequence[s].push_back(times.own_of[s] * 1e3);
  }
  const auto timings = timings_json(ablation, a.threads ? a.threads : usable_cores());
  write_file((folder / "timings.json").string(), timings);
  write_file((folder / "results.csv").string(), results_csv(ablation.results));
  write_file((folder / "table.md").string(), table_markdown(ablation.results, cost));
  write_file((folder / "table.tex").string(), table_latex(ablation.results, cost));
  write_file((folder / "results.json").string(), results_json(ablation.results));
  remove_old_files(folder, before);
  try {
    write_report_html((folder / "report.html").string(),
                      study_report(*study, trials->front(), ablation.results, timings, folder));
  } catch (const Error& e) {
    if (e.exit() != Exit::input) throw;
    throw Error(e.exit(), fmt::format("{}\n  delete it, and --resume makes it again", e.what()));
  }
  if (!a.progress.quiet) {
    print_saving(ablation);
    fmt::print(stderr, "{}\n{}\n", (folder / "table.md").string(), (folder / "report.html").string());
  }
  return 0;
}

}  // namespace

void add_ablate(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("ablate", "Runs a study: variants of a graph on sequences, judged by metrics.");
  auto a = std::make_shared<AblateArguments>();
  sub->add_option("study", a->study, "A study file, or the name of an installed study such as svgf.")
      ->required()
      ->type_name("STUDY");
  sub->add_option(
         "-o,--output", a->output,
         "Folder for results.json, results.csv, timings.json, table.md, table.tex, report.html, images and variants.")
      ->type_name("DIR")
      ->check(not_empty())
      ->capture_default_str();
  add_resume(*sub, a->resume, "Goes on with what the folder holds: only what is missing, or has changed, is computed.",
             a->restart);
  sub->add_flag("--check", a->check, "Checks the study, its graphs, metrics and sequences, and runs nothing.");
  sub->add_flag(
      "--images", a->images,
      "Writes all frames of all variants, in place of the first behind the warm-up, a middle one and the last.");
  sub->add_flag("--maps", a->maps, "Writes the error maps of metrics for the same frames.");
  sub->add_option("--references", a->references,
                  "Folder where references are kept that a source node makes; runs may share it. Default: "
                  "DIR/references.")
      ->type_name("DIR")
      ->check(not_empty());
  sub->add_option("--threads", a->threads, "Threads; 0: every core that affinity and quotas grant.")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->add_option("--max-memory", a->max_memory,
                  "Of images, GiB; 0: no limit. Runs variants in groups where all at once would take more.")
      ->check(CLI::Range(0.0, 1e6))
      ->group("Tuning");
  a->simd.add_to(*sub);
  a->progress.add_to(*sub);
  a->plugins.add_to(*sub);
  sub->footer(
      "Examples:\n"
      "  quell ablate svgf -o svgf-study\n"
      "  quell ablate my/study.json -o out --resume --images");
  sub->callback([a, &exit] { exit = run(*a); });
}

}  // namespace quell
