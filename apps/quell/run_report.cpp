// What a run took.
#include "apps/quell/run_report.h"

#include "apps/quell/options.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace quell {

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

// Of the process, MiB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

struct Summary {
  double mean = 0;
  float minimum = 0, maximum = 0;
};
Summary summary_of(const ReportedValue& v) {
  Summary s;
  if (v.frames.empty()) return s;
  s.minimum = s.maximum = v.frames.front().second;
  for (const auto& [frame, number] : v.frames) {
    s.mean += double(number) / double(v.frames.size());
    s.minimum = std::min(s.minimum, number), s.maximum = std::max(s.maximum, number);
  }
  return s;
}

double per_frame(const RunReport& r, double seconds) { return r.frames ? 1e3 * seconds / double(r.frames) : 0; }

}  // namespace

std::string summary_text(const RunReport& r) {
  return fmt::format(
      "{} frames in {:.2f} s on {} threads, {:.1f} ms a frame; frames without history: {}\n"
      "ms a frame, wall (cpu): read {:.1f} ({:.1f}), filter {:.1f} ({:.1f}), write {:.1f} ({:.1f}); images {:.0f} MiB, "
      "peak {:.0f} MiB\n",
      r.frames, r.wall, r.threads, per_frame(r, r.wall), r.resets, per_frame(r, r.read_wall), per_frame(r, r.read_cpu),
      per_frame(r, r.filter_wall), per_frame(r, r.filter_cpu), per_frame(r, r.write_wall), per_frame(r, r.write_cpu),
      double(r.plan_bytes) / kMiB, peak_memory());
}

std::string times_text(const RunReport& r) {
  double sum = 0;
  for (const auto& n : r.nodes) sum += n.wall;
  std::string out = fmt::format("{:<28} {:<20} {:>10} {:>7}\n", "node", "type", "ms/frame", "share");
  for (const auto& n : r.nodes)
    if (n.wall > 0)
      out +=
          fmt::format("{:<28} {:<20} {:>10.2f} {:>6.1f}%\n", n.name, n.type, per_frame(r, n.wall), 100 * n.wall / sum);
  return out + fmt::format("{:<28} {:<20} {:>10.2f}\n", "all", "", per_frame(r, sum));
}

std::string values_text(std::span<const ReportedValue> values) {
  std::string out;
  for (const auto& v : values)
    if (const auto s = summary_of(v); !v.frames.empty())
      out += fmt::format("{}: {:.6g} on average, {:.6g} to {:.6g}\n", v.name, s.mean, s.minimum, s.maximum);
  return out;
}

void write_report(const std::string& path, const Graph& graph, const RunReport& r,
                  std::span<const ReportedValue> values, const Provenance& provenance) {
  nlohmann::ordered_json j;
  j["quell_report"] = 1;
  j["graph"] = graph.name;
  j["fingerprint"] = fingerprint(graph);
  j["frames"] = r.frames;
  j["threads"] = r.threads;
  j["frames_in_flight"] = r.frames_in_flight;
  j["simd"] = simd_in_use();
  j["resets"] = r.resets;
  j["seconds"] = r.wall;
  for (const auto& [name, wall, cpu] : {std::tuple{"read", r.read_wall, r.read_cpu},
                                        {"filter", r.filter_wall, r.filter_cpu},
                                        {"write", r.write_wall, r.write_cpu}})
    j[name] = {{"ms_per_frame", per_frame(r, wall)}, {"cpu_ms_per_frame", per_frame(r, cpu)}};
  j["image_bytes"] = r.plan_bytes;
  j["peak_bytes"] = std::uint64_t(peak_memory() * kMiB);
  auto& nodes = j["nodes"] = nlohmann::ordered_json::array();
  for (const auto& n : r.nodes)
    nodes.push_back({{"name", n.name}, {"type", n.type}, {"ms_per_frame", per_frame(r, n.wall)}});
  auto& numbers = j["values"] = nlohmann::ordered_json::object();
  for (const auto& v : values) {
    const auto s = summary_of(v);
    auto& entry = numbers[v.name] = {{"mean", s.mean}, {"minimum", s.minimum}, {"maximum", s.maximum}};
    auto& frames = entry["frames"] = nlohmann::ordered_json::object();
    for (const auto& [frame, number] : v.frames) frames[std::to_string(frame)] = number;
  }
  j["provenance"] = nlohmann::ordered_json::parse(provenance.report());
  const std::string text = j.dump(2) + "\n";
  if (path == "-") {
    std::fputs(text.c_str(), stdout);
    return;
  }
  write_file(path, text);
}

}  // namespace quell
