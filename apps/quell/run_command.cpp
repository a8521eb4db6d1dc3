// quell run: a graph over a sequence, to files.
#include "apps/quell/command.h"
#include "apps/quell/file_sink.h"
#include "apps/quell/interrupt.h"
#include "apps/quell/options.h"
#include "apps/quell/previews.h"
#include "apps/quell/progress.h"
#include "apps/quell/run_report.h"

#include "core/report/suggest.h"
#include "core/run/memory_limit.h"
#include "core/sequence/frame_range.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace quell {

namespace {

struct RunArguments {
  PluginOptions plugins;
  GraphOptions graph;
  SequenceOptions sequence;
  std::vector<std::string> output;
  std::string compression = "zip", save_state, load_state, report, trace;
  PreviewOptions preview;
  bool full = false, times = false;
  int threads = 0, band_rows = 0;
  double max_memory = 0;  // GiB
  SimdOption simd;
  ProgressOption progress;
};

WriteOptions write_options(const RunArguments& a) {
  WriteOptions options;
  options.half = !a.full;
  options.compression = *parse_exr_compression(a.compression);  // checked by its option
  return options;
}

std::string compression_option(const std::string& text) {
  if (parse_exr_compression(text)) return "";
  const auto name = text.substr(0, text.find(':'));
  const auto known = exr_compressions();
  if (std::ranges::find(known, name) == known.end())
    return fmt::format("'{}' is not possible\n  {}", name, possibilities("it takes", name, known));
  return fmt::format(
      "'{}' is not possible\n  zip and zips take a level from 1 to 12, dwaa and dwab one from 0 to 100000, "
      "the others none",
      text);
}

// The same error, and how far the run had come.
[[noreturn]] void rethrow_with(const Error& e, const FileSink& sink) {
  const auto& frames = sink.written();
  if (frames.empty()) throw e;
  throw Error(e.exit(), fmt::format("{}\n  written before: frames {}", e.what(), frame_range_text(frames)));
}

void print_repairs(const std::map<std::string, Repairs>& repairs) {
  for (const auto& [role, r] : repairs) {
    if (r.non_finite)
      fmt::print(stderr, "warning: {}: {} pixels were not finite and have been replaced\n", role, r.non_finite);
    if (r.negative)
      fmt::print(stderr, "warning: {}: {} pixels were negative and have been raised to 0\n", role, r.negative);
  }
}

int run(const RunArguments& a) {
  const auto& cancel = watch_interrupts();
  a.simd.apply();
  Commander commander(a.plugins);
  const auto sequence = commander.load(a.sequence);
  auto graph = commander.load(a.graph, sequence ? &*sequence : nullptr);
  if (!sequence || !graph) return commander.report();
  add_previews(*graph, a.preview, commander);
  std::vector<std::string> roles;
  for (const auto& input : graph->inputs) roles.push_back(input.name);
  const auto frames = commander.open(*sequence, a.sequence, roles, a.threads, &cancel);
  const int code = commander.report();
  if (!frames || code) return code ? code : int(Exit::input);

  const FileLog log(*frames);
  Provenance provenance(
      *graph, *frames, log,
      {command_line(), simd_in_use(), a.sequence.missing, a.load_state, commander.locations().graphs});
  FileSink sink(*graph, *sequence, frames->frames(), a.output, write_options(a), provenance);
  if (!a.save_state.empty()) check_writable(a.save_state);
  if (!a.report.empty() && a.report != "-") check_writable(a.report);
  if (!a.trace.empty()) check_writable(a.trace);
  RunOptions options;
  options.threads = a.threads;
  options.band_rows = a.band_rows;
  options.max_memory = std::size_t(a.max_memory * 1024 * 1024 * 1024);
  options.load_state = a.load_state;
  options.save_state = a.save_state;
  options.cancel = &cancel;
  Trace trace;
  if (!a.trace.empty()) options.trace = &trace;
  RunReport report;
  try {
    ProgressPrinter progress(a.progress.style());
    options.progress = [&](const Progress& p) { progress(p); };
    report = run_graph(*graph, *frames, sink, options);
  } catch (const Error& e) {
    rethrow_with(e, sink);
  }
  print_repairs(frames->repairs());
  for (const auto frame : report.resized)
    fmt::print(stderr, "warning: frame {} has another size than the frame before: its history began anew\n", frame);
  if (report.wanted_bytes)
    fmt::print(stderr, "warning: {} of {} frames in flight: all would take {}, more than --max-memory\n",
               report.frames_in_flight, Overlap{}.frames_in_flight(), size_text(report.wanted_bytes));
  if (!a.progress.quiet && a.progress.style() != ProgressStyle::json) {
    fmt::print(stderr, "{}", summary_text(report));
    for (std::size_t i = 0; i < sink.patterns().size(); ++i)
      if (graph->outputs[i].type != QUELL_VALUE)
        fmt::print(stderr, "{}: {}\n", graph->outputs[i].name, sink.patterns()[i].text());
    fmt::print(stderr, "{}", values_text(sink.values()));
  }
  if (a.times) fmt::print(stderr, "{}", times_text(report));
  if (!a.report.empty()) write_report(a.report, *graph, report, sink.values(), provenance);
  if (!a.trace.empty()) trace.write(a.trace);
  return 0;
}

}  // namespace

void add_run(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("run", "Runs a graph over a sequence and writes its outputs.");
  auto a = std::make_shared<RunArguments>();
  a->graph.add_to(*sub);
  a->sequence.add_to(*sub, true);
  repeatable(sub->add_option(
                 "-o,--output", a->output,
                 "Where outputs go: a pattern for the first, NAME=PATTERN for any. Default: out/<name>.####.exr; the "
                 "others are written beside the first."))
      ->type_name("PATTERN");
  sub->add_flag("--float", a->full, "Writes 32-bit floats in place of halves.");
  sub->add_option("--compression", a->compression,
                  "Of EXR files. A level may follow: zip:9 (1 to 12, time for size), dwaa:100 (0 to 100000, size for "
                  "quality). b44, dwaa and, of floats, pxr24 lose precision.")
      ->check(compression_option)
      ->type_name("NAME[:LEVEL]")
      ->capture_default_str();
  a->preview.add_to(*sub);
  sub->add_option("--threads", a->threads,
                  "Threads; 0: every core that affinity and quotas grant. 1 reads, filters and "
                  "writes one after the other.")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->add_option("--band-rows", a->band_rows, "Rows of a band; 0: chosen per node. Changes no result.")
      ->check(CLI::Range(0, 1 << 20))
      ->group("Tuning");
  sub->add_option(
         "--max-memory", a->max_memory,
         "Of images, GiB; 0: no limit. Gives up reading and writing beside filtering to keep to it, and refuses "
         "to start where that is not enough.")
      ->check(CLI::Range(0.0, 1e6))
      ->group("Tuning");
  sub->add_option("--save-state", a->save_state, "Saves the history after the last frame.")
      ->type_name("FILE")
      ->group("Chunks");
  sub->add_option("--load-state", a->load_state, "Goes on from a saved history.")->type_name("FILE")->group("Chunks");
  a->simd.add_to(*sub);
  a->progress.add_to(*sub);
  sub->add_flag("--times", a->times, "Prints the time of each node and the memory.");
  sub->add_option("--report", a->report, "Writes times, memory and frames as JSON; - is stdout.")->type_name("FILE");
  sub->add_option("--trace", a->trace, "Writes what ran when, for chrome://tracing or Perfetto.")->type_name("FILE");
  a->plugins.add_to(*sub);
  sub->footer(
      "Examples:\n"
      "  quell run svgf room -o 'out/color.####.exr' --preview\n"
      "  quell run svgf shot.json --frames 1-20 --set alpha=0.1 --tap blend.image\n"
      "  quell run svgf shot.json --frames 0-49 --save-state a.state; quell run svgf shot.json --frames 50-99 "
      "--load-state a.state\n"
      "  quell run svgf shot.json --swap by_normal=plane_weight --bypass level0.by_luminance");
  sub->callback([a, &exit] { exit = run(*a); });
}

}  // namespace quell
