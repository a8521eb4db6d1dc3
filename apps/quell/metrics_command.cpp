// quell metrics: by what images can be judged.
#include "apps/quell/command.h"

#include "core/lab/metric.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace quell {

namespace {

struct MetricsArguments {
  PluginOptions plugins;
  std::string name;
  bool json = false, markdown = false;
};

const char* better(const Metric& m) { return m.key.higher_is_better ? "higher" : "lower"; }
std::string perfect(const Metric& m) { return m.key.perfect ? fmt::format("{}", *m.key.perfect) : ""; }

// What it reads beside the judged image; a ? marks what it can do without.
std::vector<std::string> reads(const Metric& m) {
  std::vector<std::string> names;
  for (const auto& in : m.graph.inputs)
    if (in.name != kJudged) names.push_back(in.name + (in.optional ? "?" : ""));
  return names;
}

nlohmann::ordered_json as_json(const Metric& m) {
  nlohmann::ordered_json j{{"name", m.name}, {"title", m.title}, {"about", m.about}, {"better", better(m)}};
  j["unit"] = m.key.unit;
  j["perfect"] = m.key.perfect ? nlohmann::ordered_json(*m.key.perfect) : nlohmann::ordered_json();
  auto& inputs = j["inputs"] = nlohmann::ordered_json::object();
  for (const auto& in : m.graph.inputs) inputs[in.name] = {{"type", type_name(in.type)}, {"optional", in.optional}};
  j["map"] = std::ranges::any_of(m.graph.outputs, [](const auto& out) { return out.name == "map"; });
  return j;
}

void print_text(const Metric& m) {
  fmt::print("{}: {}\n{}\n", m.name, m.title, m.about);
  fmt::print("{} is better{}{}\n", better(m), m.key.unit.empty() ? "" : ", in " + m.key.unit,
             m.key.perfect ? fmt::format("; {} for the reference itself", perfect(m)) : "");
  fmt::print("judges {}; reads {}\n", kJudged, fmt::join(reads(m), ", "));
}

void print_markdown(const std::vector<Metric>& metrics) {
  fmt::print("| metric | better | unit | perfect | reads | |\n|---|---|---|---|---|---|\n");
  for (const auto& m : metrics) {
    std::string about;
    for (const char c : m.about) about += c == '|' ? "\\|" : std::string(1, c);
    fmt::print("| `{}` | {} | {} | {} | {} | **{}.** {} |\n", m.name, better(m), m.key.unit, perfect(m),
               fmt::join(reads(m), ", "), m.title, about);
  }
}

int metrics(const MetricsArguments& a) {
  Commander commander(a.plugins);
  const auto& graphs = commander.locations().graphs;
  std::vector<std::string> names{a.name};
  if (a.name.empty()) names = installed_metrics(graphs);
  std::vector<Metric> all;
  for (const auto& name : names)
    if (auto metric = load_metric(name, graphs, commander.registry(), commander.diagnostics()))
      all.push_back(std::move(*metric));
  const int code = commander.report();
  if (a.json) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& m : all) list.push_back(as_json(m));
    fmt::print("{}\n", list.dump(2));
  } else if (a.markdown) {
    print_markdown(all);
  } else if (!a.name.empty()) {
    for (const auto& m : all) print_text(m);
  } else {
    for (const auto& m : all) fmt::print("{:<20} {:<7} {:<4} {}\n", m.name, better(m), m.key.unit, m.title);
  }
  return code;
}

}  // namespace

void add_metrics(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("metrics", "Lists the metrics that there are, or tells all about one.");
  auto a = std::make_shared<MetricsArguments>();
  sub->add_option("name", a->name, "A metric or the file of one; without, all that are installed.")->type_name("NAME");
  auto* json = sub->add_flag("--json", a->json, "As JSON.");
  sub->add_flag("--markdown", a->markdown, "As a table in Markdown.")->excludes(json);
  a->plugins.add_to(*sub);
  sub->footer("Examples:\n  quell metrics\n  quell metrics psnr_pu\n  quell metrics my_metric.json");
  sub->callback([a, &exit] { exit = metrics(*a); });
}

}  // namespace quell
