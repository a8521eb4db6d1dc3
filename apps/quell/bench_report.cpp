// Measurements and comparisons as tables.
#include "apps/quell/bench_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

std::string change_line(const TimeChange& c) {
  const char* words[] = {"same", "faster", "slower"};
  return fmt::format("{:<28} {:>9.2f} {:>9.2f} {:>+7.1f}% {:>9.2f}  {}\n", c.name, c.before.median, c.now.median,
                     c.percent(), std::max(c.before.quartiles_apart(), c.now.quartiles_apart()), words[int(c.pace)]);
}

}  // namespace

std::string timing_text(const Timing& m) {
  double sum = 0;
  for (const auto& n : m.nodes) sum += n.ms.median;
  std::string out = fmt::format("{}: {}x{}, {} input, {} frames after {} to warm up, {} threads, {}\n", m.graph,
                                m.width, m.height, m.input, m.frames, m.warmup, m.threads, m.simd);
  out += fmt::format("{:<28} {:<20} {:>9} {:>9} {:>7} {:>7} {:>8} {:>8}\n", "node", "type", "ms/frame", "minimum",
                     "share", "GB/s", "Mpix/s", "Mtap/s");
  for (const auto& n : m.nodes)
    out += fmt::format("{:<28} {:<20} {:>9.2f} {:>9.2f} {:>6.1f}% {:>7.2f} {:>8.1f} {:>8}\n", n.name, n.type,
                       n.ms.median, n.ms.minimum, sum > 0 ? 100 * n.ms.median / sum : 0, n.gigabytes_per_second(),
                       n.megapixels_per_second(), n.taps ? fmt::format("{:.0f}", n.megataps_per_second()) : "-");
  const double megapixels = double(m.width) * double(m.height) * 1e-6;
  out += fmt::format("{:<28} {:<20} {:>9.2f} {:>9.2f} {:>7} {:>7} {:>8.1f}\n", "whole graph", "", m.ms.median,
                     m.ms.minimum, "", "", m.ms.median > 0 ? 1e3 * megapixels / m.ms.median : 0);
  out += fmt::format("half of the frames took {:.2f} to {:.2f} ms; CPU {:.2f} ms a frame ({:.2f} of {} threads busy)\n",
                     m.ms.lower, m.ms.upper, m.cpu_ms.median, m.ms.median > 0 ? m.cpu_ms.median / m.ms.median : 0,
                     m.threads);
  out += fmt::format("reading, apart: {:.2f} ms a frame; frames without history: {}\n", m.read_ms, m.resets);
  return out + fmt::format("images {:.0f} MiB; peak of the process, input included, {:.0f} MiB\n",
                           double(m.image_bytes) / kMiB, double(m.peak_bytes) / kMiB);
}

std::string comparison_text(const TimingComparison& c, const std::string& name) {
  std::string out = fmt::format("\nagainst {}, medians in ms\n", name);
  for (const auto& note : c.notes) out += note + '\n';
  out += fmt::format("{:<28} {:>9} {:>9} {:>8} {:>9}\n", "node", "before", "now", "change", "spread");
  for (const auto& node : c.nodes) out += change_line(node);
  for (const auto& node : c.added) out += fmt::format("{:<28} only now\n", node);
  for (const auto& node : c.removed) out += fmt::format("{:<28} only before\n", node);
  return out + change_line(c.total);
}

}  // namespace quell
