// quell graph: draws a graph, describes it, or writes it with its subgraphs and edits resolved.
#include "apps/quell/command.h"
#include "apps/quell/options.h"

#include "core/graph/draw.h"
#include "core/graph/guide.h"
#include "core/graph/write.h"

#include <fmt/format.h>

namespace quell {

namespace {

struct GraphArguments {
  PluginOptions plugins;
  GraphOptions graph;
  std::string format = "dot";
};

std::string resolved(const Graph& graph, const GraphInfo& info, const std::filesystem::path& graphs) {
  auto written = write_graph(graph, graphs, info.metric);
  for (const auto& file : written.files)
    fmt::print(stderr, "warning: a graph names no files, so this belongs to its command line: --set '{}'\n", file);
  return std::move(written.text);
}

int draw(const GraphArguments& a) {
  Commander commander(a.plugins);
  GraphInfo info;
  const auto graph = commander.load(a.graph, nullptr, &info);
  const int code = commander.report();
  if (!graph) return code;
  fmt::print("{}", a.format == "svg"        ? draw_svg(*graph)
                   : a.format == "mermaid"  ? draw_mermaid(*graph)
                   : a.format == "markdown" ? guide_markdown(info, *graph)
                   : a.format == "json"     ? resolved(*graph, info, commander.locations().graphs)
                                            : draw_dot(*graph));
  return code;
}

}  // namespace

void add_graph(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("graph", "Draws a graph, with its subgraphs expanded, describes it, or writes it.");
  auto a = std::make_shared<GraphArguments>();
  a->graph.add_to(*sub);
  sub->add_option("--format", a->format,
                  "How: as text for Graphviz or Mermaid, as a picture, in words, or as a graph file in which "
                  "subgraphs and edits are resolved and every parameter is spelt out.")
      ->check(one_of({"dot", "mermaid", "svg", "markdown", "json"}))
      ->type_name("")
      ->capture_default_str();
  a->plugins.add_to(*sub);
  sub->footer(
      "Examples:\n  quell graph svgf --format svg > svgf.svg\n  quell graph svgf | dot -Tpdf > svgf.pdf\n"
      "  quell graph svgf --set alpha=0.1 --bypass level4 --format json > mine.json");
  sub->callback([a, &exit] { exit = draw(*a); });
}

}  // namespace quell
