// quell check: every error of a graph, and of the sequence that it is to run over; nothing is run.
#include "apps/quell/command.h"

#include "core/run/plan.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quell {

namespace {

struct CheckArguments {
  PluginOptions plugins;
  GraphOptions graph;
  SequenceOptions sequence;
};

int check(const CheckArguments& a) {
  Commander commander(a.plugins);
  std::optional<Sequence> sequence;
  if (!a.sequence.sequence.empty()) sequence = commander.load(a.sequence);
  GraphInfo info;
  const auto graph = commander.load(a.graph, sequence ? &*sequence : nullptr, &info);
  if (!graph || (!a.sequence.sequence.empty() && !sequence)) return commander.report();
  if (sequence) {
    std::vector<std::string> roles;
    for (const auto& input : graph->inputs) roles.push_back(input.name);
    const auto frames = commander.open(*sequence, a.sequence, roles, 1, nullptr);
    if (frames && !frames->frames().empty()) {
      const Plan plan(*graph, frames->shapes(frames->frames()[0], roles));
      fmt::print("{} frames; {:.0f} MiB for images\n", frames->frames().size(), double(plan.bytes()) / 1048576.0);
    }
  }
  const int code = commander.report();
  if (code == 0) {
    std::vector<std::string> inputs;
    for (const auto& input : info.inputs)
      inputs.push_back(fmt::format("{} ({}{})", input.name, type_name(input.type), input.optional ? ", optional" : ""));
    fmt::print("{}: good: {} nodes\n  inputs: {}\n  outputs: {}\n", info.file, graph->nodes.size(),
               fmt::join(inputs, ", "), fmt::join(info.outputs, ", "));
    for (const auto& p : info.params) fmt::print("  param {} = {}  {}\n", p.name, p.value, p.doc);
  }
  return code;
}

}  // namespace

void add_check(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("check", "Reports every error of a graph, with file, line and column; runs nothing.");
  auto a = std::make_shared<CheckArguments>();
  a->graph.add_to(*sub);
  a->sequence.add_to(*sub, false);
  a->plugins.add_to(*sub);
  sub->footer("Examples:\n  quell check my_graph.json\n  quell check svgf shot.json --set alpha=0.1");
  sub->callback([a, &exit] { exit = check(*a); });
}

}  // namespace quell
