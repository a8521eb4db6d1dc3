// quell check: every error of a graph, and of the sequence that it is to run over; nothing is run.
#include "apps/quell/command.h"

#include "core/run/plan.h"
#include "core/sequence/frame_range.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace quell {

namespace {

using nlohmann::ordered_json;

struct CheckArguments {
  PluginOptions plugins;
  GraphOptions graph;
  SequenceOptions sequence;
  bool json = false;
};

// What is known of a graph and sequence without errors.
struct Findings {
  GraphInfo info;
  std::size_t nodes = 0;
  std::string fingerprint;
  std::optional<std::vector<std::int64_t>> frames;
  std::size_t bytes = 0;  // of images, for the first frame
};

// Errors go to the commander's diagnostics, or are thrown where nothing can follow them.
std::optional<Findings> examine(Commander& commander, const CheckArguments& a) {
  Findings found;
  std::optional<Sequence> sequence;
  const bool wanted = !a.sequence.sequence.empty();
  if (wanted) sequence = commander.load(a.sequence);
  const auto graph = commander.load(a.graph, sequence ? &*sequence : nullptr, &found.info);
  if (!graph || (wanted && !sequence)) return std::nullopt;
  found.nodes = graph->nodes.size();
  found.fingerprint = fingerprint(*graph);
  if (!sequence) return found;
  std::vector<std::string> roles;
  for (const auto& input : graph->inputs) roles.push_back(input.name);
  const auto frames = commander.open(*sequence, a.sequence, roles, 1, nullptr);
  if (!frames) return std::nullopt;
  found.frames = frames->frames();
  if (!found.frames->empty()) found.bytes = Plan(*graph, frames->shapes(found.frames->front(), roles)).bytes();
  return found;
}

// `name` is the graph as it was asked for.
std::string text_of(const std::string& name, const Findings& f) {
  std::vector<std::string> inputs;
  for (const auto& input : f.info.inputs)
    inputs.push_back(fmt::format("{} ({}{})", input.name, type_name(input.type), input.optional ? ", optional" : ""));
  std::string out = fmt::format("{}: good: {} nodes\n  inputs: {}\n  outputs: {}\n", name, f.nodes,
                                fmt::join(inputs, ", "), fmt::join(f.info.outputs, ", "));
  for (const auto& p : f.info.params) out += fmt::format("  param {} = {}  {}\n", p.name, p.value, p.doc);
  if (f.frames)
    out += fmt::format("  {} frame{}: {}; {:.1f} MiB for images\n", f.frames->size(), f.frames->size() == 1 ? "" : "s",
                       frame_range_text(*f.frames), double(f.bytes) / 1048576.0);
  return out;
}

ordered_json json_of(const Diagnostics& diagnostics) {
  auto list = ordered_json::array();
  for (const auto* d : diagnostics.in_order()) {
    const auto place = diagnostics.sources.place_parts(d->position);
    std::vector<std::string> notes = d->notes;
    std::erase(notes, "");
    list.push_back({{"severity", d->severity == Severity::error ? "error" : "warning"},
                    {"file", place.name},
                    {"line", place.line},
                    {"column", place.column},
                    {"path", d->path},
                    {"text", d->text},
                    {"notes", notes}});
  }
  return list;
}

ordered_json json_of(const Findings& f) {
  ordered_json j = {{"file", f.info.file}, {"name", f.info.name}, {"nodes", f.nodes}, {"fingerprint", f.fingerprint}};
  auto& inputs = j["inputs"] = ordered_json::array();
  for (const auto& in : f.info.inputs)
    inputs.push_back({{"name", in.name}, {"type", type_name(in.type)}, {"optional", in.optional}});
  j["outputs"] = f.info.outputs;
  auto& params = j["params"] = ordered_json::array();
  for (const auto& p : f.info.params)
    params.push_back({{"name", p.name},
                      {"value", ordered_json::parse(p.value, nullptr, false)},
                      {"takes", p.takes},
                      {"doc", p.doc}});
  if (f.frames) j["frames"] = *f.frames, j["image_bytes"] = f.bytes;
  return j;
}

int check(const CheckArguments& a) {
  Commander commander(a.plugins);
  std::optional<Findings> found;
  try {
    found = examine(commander, a);
  } catch (const Error& e) {
    commander.diagnostics().error({}, "", e.what(), {}, e.exit());
  }
  const int code = commander.report();
  if (a.json) {
    ordered_json j = {{"quell_check", 1}, {"good", code == 0}, {"exit", code}};
    j["diagnostics"] = json_of(commander.diagnostics());
    if (found && code == 0) j["graph"] = json_of(*found);
    fmt::print("{}\n", j.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  } else if (found && code == 0) {
    fmt::print("{}", text_of(a.graph.graph, *found));
  }
  return code;
}

}  // namespace

void add_check(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("check", "Reports every error of a graph, with file, line and column; runs nothing.");
  auto a = std::make_shared<CheckArguments>();
  a->graph.add_to(*sub);
  a->sequence.add_to(*sub, false);
  sub->add_flag("--json", a->json, "Writes what was found as JSON to stdout.");
  a->plugins.add_to(*sub);
  sub->footer(
      "Examples:\n  quell check my_graph.json\n  quell check svgf shot.json --set alpha=0.1\n"
      "  quell check svgf shot.json --json | jq '.diagnostics[].text'");
  sub->callback([a, &exit] { exit = check(*a); });
}

}  // namespace quell
