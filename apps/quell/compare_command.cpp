// quell compare: pictures of any tool against a reference, judged by metrics.
#include "apps/quell/command.h"
#include "apps/quell/comparison.h"
#include "apps/quell/interrupt.h"
#include "apps/quell/options.h"
#include "apps/quell/pictures.h"
#include "apps/quell/progress.h"

#include "core/lab/results.h"
#include "core/lab/threshold.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace quell {

namespace {

struct CompareArguments {
  PluginOptions plugins;
  ComparisonRequest request;
  std::vector<std::string> pictures, metrics, fail;
  std::string json, csv;
  SimdOption simd;
  ProgressOption progress;
};

std::vector<std::string> split_names(const std::vector<std::string>& lists) {
  std::vector<std::string> names;
  for (const auto& list : lists)
    for (std::size_t at = 0; at <= list.size();) {
      const auto end = std::min(list.find(',', at), list.size());
      if (end > at) names.push_back(list.substr(at, end - at));
      at = end + 1;
    }
  return names;
}

void write_text(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::fputs(text.c_str(), stdout);
    return;
  }
  write_file(path, text);
}

// Exit::threshold when one of them is met, and says so.
int check(const Results& results, const std::vector<Threshold>& thresholds) {
  int code = 0;
  const auto all = summaries(results);
  for (const auto& t : thresholds)
    for (const auto& s : all) {
      if (results.metrics[s.metric].name != t.metric || s.sequence != std::optional<std::size_t>(0)) continue;
      const auto& name = results.variants[s.variant].name;
      if (s.summary.count == 0)
        throw Error(Exit::input, fmt::format("--fail '{}': no frame of {} has a number of this metric", t.text, name));
      const double number = t.of(s.summary);
      if (!t.met_by(number)) continue;
      fmt::print(stderr, "failed: {}: {}: the {} is {:.6g}\n", name, t.text, t.statistic, number);
      code = int(Exit::threshold);
    }
  return code;
}

int compare(CompareArguments& a) {
  const auto& cancel = watch_interrupts();
  a.simd.apply();
  std::vector<Threshold> thresholds;
  for (const auto& text : a.fail) thresholds.push_back(parse_threshold(text, "--fail"));
  a.request.pictures.clear();
  for (const auto& text : a.pictures) a.request.pictures.push_back(parse_pictures(text));
  a.request.metrics = split_names(a.metrics);
  a.request.thresholds = thresholds;
  a.request.cancel = &cancel;
  if (!a.json.empty() && !a.csv.empty() && plain_path(a.json) == plain_path(a.csv))
    throw Error(Exit::usage,
                fmt::format("--json and --csv would both go to {}", a.json == "-" ? "the standard output" : a.json));
  for (const auto& file : {a.json, a.csv})
    if (!file.empty() && file != "-") check_writable(file), a.request.written.push_back(file);
  a.request.warn = [](const std::string& text) { fmt::print(stderr, "warning: {}\n", text); };

  Commander commander(a.plugins);
  std::optional<Results> results;
  {
    ProgressPrinter progress(a.progress.style());  // its line ends before what follows begins
    results = run_comparison(commander, a.request, [&](const Progress& p) { progress(p); });
  }
  if (const int code = commander.report(); code || !results) return code ? code : int(Exit::input);
  if (!a.json.empty()) write_text(a.json, results_json(*results));
  if (!a.csv.empty()) write_text(a.csv, results_csv(*results));
  if (!a.progress.quiet && a.json != "-" && a.csv != "-") fmt::print("{}", comparison_text(*results));
  return check(*results, thresholds);
}

}  // namespace

void add_compare(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("compare", "Judges pictures of any tool by a reference.");
  auto a = std::make_shared<CompareArguments>();
  sub->add_option("pictures", a->pictures,
                  "Files or patterns of them (color.####.exr), sequence files or built-in sequences, whose colour is "
                  "meant; NAME=… names them in tables.")
      ->required()
      ->type_name("[NAME=]PICTURES…");
  sub->add_option("--reference", a->request.reference,
                  "What they are judged by: pictures too, or a sequence, whose reference is meant.")
      ->check(not_empty())
      ->type_name("PICTURES");
  sub->add_option("--sequence", a->request.sequence,
                  "What metrics over time and of regions read besides: motion, ids, normals. Default: the reference, "
                  "where that is a sequence.")
      ->check(not_empty())
      ->type_name("SEQUENCE");
  repeatable(
      sub->add_option("--metric", a->metrics,
                      "Metrics with commas between: installed ones or files. Default: relmse, psnr_pu, ssim and flip; "
                      "psnr_unbiased where the reference has halves, and flicker where motion is known."))
      ->type_name("NAME,…");
  repeatable(sub->add_option(
                 "--fail", a->fail,
                 "Ends with exit code 1 when this holds: 'flip > 0.05', 'psnr_ldr.min < 30'. Of the frames' numbers "
                 "mean is meant, or median, p95, min, max. May be given more than once."))
      ->type_name("CONDITION");
  sub->add_option("--frames", a->request.frames, "Frames to compare: 1-20, 1-10x2, 1,5,7-9. Default: all.")
      ->check(not_empty())
      ->type_name("RANGE");
  sub->add_option("--root", a->request.root, "Folder that sequence files' names are relative to.")
      ->check(not_empty())
      ->type_name("DIR");
  sub->add_option("--references", a->request.references,
                  "Folder where references are kept that a source node makes, so that they are made once; studies and "
                  "suites may share it.")
      ->check(not_empty())
      ->type_name("DIR");
  sub->add_option("--warm-up", a->request.warm_up, "Frames at the beginning that enter no mean.")
      ->check(CLI::Range(0, 1 << 30))
      ->capture_default_str();
  sub->add_option("--json", a->json, "Writes all numbers as JSON; - is stdout.")->check(not_empty())->type_name("FILE");
  sub->add_option("--csv", a->csv, "Writes a line for each number; - is stdout.")
      ->check(not_empty())
      ->type_name("FILE");
  sub->add_option("--maps", a->request.maps, "Writes error images there, as EXR and for the eye as PNG.")
      ->check(not_empty())
      ->type_name("DIR");
  sub->add_option("--threads", a->request.threads, "Threads; 0: every core that affinity and quotas grant.")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  a->simd.add_to(*sub);
  a->progress.add_to(*sub);
  a->plugins.add_to(*sub);
  sub->footer(
      "Examples:\n"
      "  quell compare denoised.png --reference truth.png --fail 'flip > 0.05'\n"
      "  quell compare svgf=out/svgf/color.####.exr new=out/new/color.####.exr --reference room --frames 0-15\n"
      "  quell compare a.####.exr b.####.exr --reference shot.json --metric psnr_unbiased,flicker --csv numbers.csv");
  sub->callback([a, &exit] { exit = compare(*a); });
}

}  // namespace quell
