// Chooses and loads the metrics of a comparison.
#include "apps/quell/judges.h"

#include "core/lab/halves.h"
#include "core/report/error.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

namespace quell {

namespace {

constexpr const char* kUsual[] = {"psnr_unbiased", "relmse", "psnr_pu", "ssim", "flip", "flicker"};

// Read as if all were there that it can read.
std::optional<Metric> load_any(Commander& commander, const std::string& name, Diagnostics& diagnostics) {
  return load_metric(name, commander.locations().graphs, commander.registry(), diagnostics);
}

void refuse(const Metric& metric, const std::map<std::string, int>& roles, Diagnostics& diagnostics) {
  for (const auto& input : metric.graph.inputs) {
    if (input.optional || roles.contains(input.name)) continue;
    std::string why = "--sequence names what has it";
    if (is_reference(input.name))
      why = input.name == "reference"
                ? "--reference names it"
                : R"(it is one of two halves, as a sequence has with "reference": {"A": …, "B": …})";
    diagnostics.error({}, "", fmt::format("the metric '{}' reads '{}', which is not there", metric.name, input.name),
                      {why});
  }
}

}  // namespace

std::vector<WantedMetric> wanted_metrics(const std::vector<std::string>& named,
                                         const std::vector<Threshold>& thresholds) {
  std::vector<WantedMetric> wanted;
  for (const auto& name : named) wanted.push_back({name, true});
  if (named.empty())
    for (const auto* name : kUsual) wanted.push_back({name, false});
  for (const auto& t : thresholds) {
    const auto same = std::ranges::find_if(
        wanted, [&](const WantedMetric& w) { return std::filesystem::path(w.name).stem() == t.metric; });
    if (same == wanted.end())
      wanted.push_back({t.metric, true});
    else
      same->asked = true;
  }
  return wanted;
}

std::set<std::string> roles_of(Commander& commander, const std::vector<WantedMetric>& metrics) {
  std::set<std::string> roles;
  for (const auto& wanted : metrics) {
    Diagnostics quiet;
    if (const auto metric = load_any(commander, wanted.name, quiet))
      for (const auto& input : metric->graph.inputs)
        if (input.name != kJudged) roles.insert(input.name);
  }
  return roles;
}

std::vector<Judge> load_judges(Commander& commander, const std::vector<WantedMetric>& metrics,
                               std::map<std::string, int> roles) {
  auto& diagnostics = commander.diagnostics();
  roles.emplace(kJudged, QUELL_RADIANCE);
  std::vector<Judge> judges;
  for (const auto& wanted : metrics) {
    Diagnostics quiet;
    const auto any = load_any(commander, wanted.name, quiet);
    if (!any) {  // says what is wrong with it itself, not what it does not find here
      load_any(commander, wanted.name, diagnostics);
      continue;
    }
    std::vector<std::string> lacking;
    bool served = true;
    for (const auto& input : any->graph.inputs)
      if (!roles.contains(input.name)) lacking.push_back(input.name), served = served && input.optional;
    if (!served) {
      if (wanted.asked) refuse(*any, roles, diagnostics);
      continue;
    }
    if (std::ranges::any_of(judges, [&](const Judge& j) { return j.metric.name == any->name; })) {
      diagnostics.error({}, "--metric", fmt::format("two metrics are called '{}'", any->name));
      continue;
    }
    auto metric = load_metric(wanted.name, commander.locations().graphs, commander.registry(), diagnostics, roles);
    if (!metric) continue;
    const int back = reference_frames_back(metric->graph);
    judges.push_back({std::move(*metric), std::move(lacking), back});
  }
  if (judges.empty() && diagnostics.ok())
    throw Error(Exit::usage, "there is nothing to judge by: --reference or --sequence is missing");
  return judges;
}

void explain(const Error& e, const std::string& prefix, const std::vector<Judge>& judges) {
  if (e.exit() != Exit::plugin) return;
  for (const auto& judge : judges)
    if (!judge.lacking.empty() && std::string_view(e.what()).starts_with(prefix + judge.metric.name + "."))
      throw Error(Exit::usage, fmt::format("{}\n  '{}' reads {} where that is there; --sequence names what has it",
                                           e.what(), judge.metric.name, fmt::join(judge.lacking, ", ")));
}

}  // namespace quell
