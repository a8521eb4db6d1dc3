// quell plan: order, reach, buffers and memory of a graph at a size.
#include "apps/quell/command.h"
#include "apps/quell/options.h"

#include "core/run/plan.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quell {

namespace {

using nlohmann::ordered_json;

struct PlanArguments {
  PluginOptions plugins;
  GraphOptions graph;
  std::string size = "1920x1080";
  int objects = 16;
  bool json = false;
};

ordered_json json_of(const Graph& graph, const Plan& plan) {
  ordered_json j = {{"quell_plan", 1}, {"graph", graph.name}, {"fingerprint", fingerprint(graph)}};
  auto& nodes = j["nodes"] = ordered_json::array();
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const auto& node = graph.nodes[n];
    const auto& planned = plan.nodes()[n];
    std::vector<std::string> reads, writes;
    for (const auto& port : node.in)
      for (const auto& wire : port) {
        const auto& name = plan.values()[plan.value_of(wire.from)].name;
        reads.push_back(wire.delay ? fmt::format("{}@-{}", name, wire.delay) : name);
      }
    for (std::size_t o = 0; o < node.type().outputs().size(); ++o)
      if (const auto& v = plan.values()[plan.value_of({int(n), int(o)})]; v.exists) writes.push_back(v.name);
    nodes.push_back(
        {{"name", node.name},
         {"type", node.type().name()},
         {"weight", node.type().is_weight()},
         {"reach", {{"rows", planned.max_row_reach}, {"anywhere", planned.anywhere}, {"step", planned.step}}},
         {"reads", reads},
         {"writes", writes},
         {"bytes", plan.bytes_of(n)}});
  }
  auto& buffers = j["buffers"] = ordered_json::array();
  for (std::size_t i = 0; i < plan.values().size(); ++i) {
    const auto& v = plan.values()[i];
    if (!v.exists) continue;
    ordered_json buffer = {{"name", v.name},
                           {"type", type_name(v.type)},
                           {"width", v.shape.width},
                           {"height", v.shape.height},
                           {"channels", v.shape.channels},
                           {"slot_bytes", v.floats * sizeof(float)},
                           {"input", i < graph.inputs.size()},
                           {"output", v.output},
                           {"delay", v.delay}};
    if (v.slots)
      buffer["ring"] = {{"slots", v.slots}};
    else
      buffer["arena"] = {{"offset", v.offset * sizeof(float)}, {"first", v.first}, {"last", v.last}};
    buffers.push_back(std::move(buffer));
  }
  j["bytes"] = {{"all", plan.bytes()},
                {"arena", plan.arena_floats() * sizeof(float)},
                {"rings", plan.ring_floats() * sizeof(float)},
                {"without_reuse", plan.bytes_without_reuse()}};
  return j;
}

int plan(const PlanArguments& a) {
  const auto [width, height] = frame_size(a.size);
  Commander commander(a.plugins);
  const auto graph = commander.load(a.graph, nullptr);
  const int code = commander.report();
  if (!graph) return code;
  std::vector<quell_shape> shapes;
  for (const auto& input : graph->inputs) {
    const auto* info = type_info(input.type);
    if (info->storage == Storage::table)
      shapes.push_back({16, input.type == QUELL_CAMERA ? 2 : a.objects, 1});
    else
      shapes.push_back({width, height, info->channels ? info->channels : 1});
  }
  const Plan plan(*graph, shapes);
  fmt::print("{}", a.json ? json_of(*graph, plan).dump(2) + "\n" : plan.describe());
  return code;
}

}  // namespace

void add_plan(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("plan", "Prints the order of nodes, their reach, the buffers and the memory.");
  auto a = std::make_shared<PlanArguments>();
  a->graph.add_to(*sub);
  sub->add_option("--size", a->size, "Frames' size, pixels.")->type_name("WxH")->capture_default_str();
  sub->add_option("--objects", a->objects, "Objects in a table of transforms.")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  sub->add_flag("--json", a->json, "Writes the plan as JSON.");
  a->plugins.add_to(*sub);
  sub->footer("Examples:\n  quell plan svgf --size 3840x2160\n  quell plan svgf --json | jq .bytes");
  sub->callback([a, &exit] { exit = plan(*a); });
}

}  // namespace quell
