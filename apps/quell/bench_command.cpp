// quell bench: how long a graph takes, node by node, without files.
#include "apps/quell/bench_report.h"
#include "apps/quell/command.h"
#include "apps/quell/interrupt.h"
#include "apps/quell/options.h"

#include "core/bench/looped_source.h"
#include "core/bench/synthetic_source.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>

namespace quell {

namespace {

struct BenchArguments {
  PluginOptions plugins;
  GraphOptions graph;
  SequenceOptions sequence;
  std::string size, json, baseline, trace;
  SimdOption simd;
  std::optional<double> fail_slower;
  int frames = 10, warmup = 4, threads = 0, band_rows = 0;
};

void check(const BenchArguments& a) {
  if (a.fail_slower && a.baseline.empty())
    throw Error(Exit::usage, "--fail-slower needs --baseline FILE: slower than what?");
  if (!a.size.empty() && !a.sequence.sequence.empty())
    throw Error(Exit::usage,
                fmt::format("--size {}: the frames of {} have a size of their own; leave one of the two out", a.size,
                            a.sequence.sequence));
  const bool edits_sequence = !a.sequence.root.empty() || !a.sequence.source.empty();
  if (edits_sequence && a.sequence.sequence.empty())
    throw Error(Exit::usage, "--root and --source belong to a SEQUENCE, and none is given");
}

Timing read_baseline(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(Exit::input, fmt::format("{}: cannot be read", path));
  return parse_timing(path, {std::istreambuf_iterator<char>(file), {}});
}

int bench(const BenchArguments& a) {
  check(a);
  const auto& cancel = watch_interrupts();
  const FrameSize size = frame_size(a.size.empty() ? "1920x1080" : a.size);
  a.simd.apply();
  // Before anything is measured in vain.
  for (const auto& path : {a.json, a.trace})
    if (!path.empty() && path != "-") check_writable(path);
  const auto baseline = a.baseline.empty() ? std::nullopt : std::optional(read_baseline(a.baseline));
  const bool synthetic = a.sequence.sequence.empty();
  Commander commander(a.plugins);
  const auto sequence = synthetic ? std::nullopt : commander.load(a.sequence);
  const auto graph = commander.load(a.graph, sequence ? &*sequence : nullptr);
  if (!graph || (!synthetic && !sequence)) return commander.report();

  const int frames = a.warmup + a.frames;
  std::unique_ptr<FrameSource> opened, source;
  if (synthetic) {
    source = std::make_unique<SyntheticSource>(*graph, size.width, size.height, frames);
  } else {
    std::vector<std::string> roles;
    for (const auto& input : graph->inputs) roles.push_back(input.name);
    opened = commander.open(*sequence, a.sequence, roles, a.threads, &cancel);
    if (opened) source = std::make_unique<LoopedSource>(*opened, frames);
  }
  const int code = commander.report();
  if (!source || code) return code ? code : int(Exit::input);

  Trace trace;
  RunOptions options;
  options.threads = a.threads;
  options.band_rows = a.band_rows;
  options.cancel = &cancel;
  if (!a.trace.empty()) options.trace = &trace;
  auto measured = measure(*graph, *source, options, a.warmup);
  measured.input = synthetic ? "synthetic" : a.sequence.sequence;
  measured.simd = simd_in_use();

  std::FILE* const people = a.json == "-" ? stderr : stdout;
  fmt::print(people, "{}", timing_text(measured));
  if (a.json == "-")
    fmt::print("{}", timing_json(measured));
  else if (!a.json.empty())
    write_file(a.json, timing_json(measured));
  if (!a.trace.empty()) trace.write(a.trace);
  if (!baseline) return 0;
  const auto comparison = compare(*baseline, measured);
  fmt::print(people, "{}", comparison_text(comparison, a.baseline));
  return a.fail_slower && slower_by(comparison, *a.fail_slower) ? int(Exit::threshold) : 0;
}

}  // namespace

void add_bench(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("bench", "Times a graph, node by node, on frames made in memory or on a sequence.");
  auto a = std::make_shared<BenchArguments>();
  a->graph.add_to(*sub);
  a->sequence.add_to(*sub, false);
  // How many are measured, in place of which.
  sub->remove_option(sub->get_option("--frames"));
  sub->add_option("--frames", a->frames, "Frames to measure; a sequence that is shorter starts anew.")
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("--warmup", a->warmup,
                  "Frames to run before them; SVGF needs 4 until all of its pixels have a history.")
      ->check(CLI::Range(0, 1 << 20))
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("--size", a->size, "Size of frames made in memory, pixels; 1920x1080 unless told.")->type_name("WxH");
  sub->add_option("--threads", a->threads, "Threads; 0: every core.")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->add_option("--band-rows", a->band_rows, "Rows of a band; 0: chosen per node. Changes no result.")
      ->check(CLI::Range(0, 1 << 20))
      ->group("Tuning");
  a->simd.add_to(*sub);
  sub->add_option("--json", a->json, "Writes the measurement as JSON; - is stdout, and the table goes to stderr.")
      ->type_name("FILE");
  sub->add_option("--baseline", a->baseline,
                  "Compares with a measurement that --json wrote. A difference counts when it exceeds the spread "
                  "between the quartiles of both, 3 % and 0.05 ms.")
      ->type_name("FILE");
  sub->add_option("--fail-slower", a->fail_slower, "Exits with 1 when the graph or a node became slower by more.")
      ->check(CLI::Range(0.0, 1e6))
      ->type_name("PERCENT");
  sub->add_option("--trace", a->trace, "Writes what ran when, for chrome://tracing or Perfetto.")->type_name("FILE");
  a->plugins.add_to(*sub);
  sub->footer(
      "Examples:\n"
      "  quell bench svgf --size 1920x1080 --json before.json\n"
      "  quell bench svgf --set level0.atrous.radius=1 --baseline before.json\n"
      "  quell bench svgf room --frames 30 --trace room.trace.json\n"
      "  quell bench svgf --baseline before.json --fail-slower 5");
  sub->callback([a, &exit] { exit = bench(*a); });
}

}  // namespace quell
