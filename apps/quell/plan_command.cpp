// quell plan: order, reach, buffers and memory of a graph at a size.
#include "apps/quell/command.h"

#include "core/run/plan.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <cstdio>

namespace quell {

namespace {

struct PlanArguments {
  PluginOptions plugins;
  GraphOptions graph;
  std::string size = "1920x1080";
  int objects = 16;
};

int plan(const PlanArguments& a) {
  Commander commander(a.plugins);
  const auto graph = commander.load(a.graph, nullptr);
  const int code = commander.report();
  if (!graph) return code;
  int width = 0, height = 0;
  char end = 0;
  if (std::sscanf(a.size.c_str(), "%dx%d%c", &width, &height, &end) != 2 || width < 1 || height < 1 || width > 65536 ||
      height > 65536)
    throw Error(Exit::usage, fmt::format("--size {}: expected WIDTHxHEIGHT in pixels, as in 1920x1080", a.size));
  std::vector<quell_shape> shapes;
  for (const auto& input : graph->inputs) {
    const auto* info = type_info(input.type);
    if (info->storage == Storage::table)
      shapes.push_back({16, input.type == QUELL_CAMERA ? 2 : a.objects, 1});
    else
      shapes.push_back({width, height, info->channels ? info->channels : 1});
  }
  fmt::print("{}", Plan(*graph, shapes).describe());
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
  a->plugins.add_to(*sub);
  sub->footer("Example:\n  quell plan svgf --size 3840x2160");
  sub->callback([a, &exit] { exit = plan(*a); });
}

}  // namespace quell
