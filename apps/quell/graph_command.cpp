// quell graph: draws a graph, or describes it.
#include "apps/quell/command.h"
#include "apps/quell/options.h"

#include "core/graph/draw.h"
#include "core/graph/guide.h"

#include <fmt/format.h>

namespace quell {

namespace {

struct GraphArguments {
  PluginOptions plugins;
  GraphOptions graph;
  std::string format = "dot";
};

int draw(const GraphArguments& a) {
  Commander commander(a.plugins);
  GraphInfo info;
  const auto graph = commander.load(a.graph, nullptr, &info);
  const int code = commander.report();
  if (!graph) return code;
  fmt::print("{}", a.format == "svg"        ? draw_svg(*graph)
                   : a.format == "mermaid"  ? draw_mermaid(*graph)
                   : a.format == "markdown" ? guide_markdown(info, *graph)
                                            : draw_dot(*graph));
  return code;
}

}  // namespace

void add_graph(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("graph", "Draws a graph, with its subgraphs expanded, or describes it.");
  auto a = std::make_shared<GraphArguments>();
  a->graph.add_to(*sub);
  sub->add_option("--format", a->format, "How: as text for Graphviz or Mermaid, as a picture, or in words.")
      ->check(one_of({"dot", "mermaid", "svg", "markdown"}))
      ->type_name("")
      ->capture_default_str();
  a->plugins.add_to(*sub);
  sub->footer("Examples:\n  quell graph svgf --format svg > svgf.svg\n  quell graph svgf | dot -Tpdf > svgf.pdf");
  sub->callback([a, &exit] { exit = draw(*a); });
}

}  // namespace quell
