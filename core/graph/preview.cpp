// Joins a preview's graph to the graph that it shows.
#include "core/graph/preview.h"

#include "core/report/error.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <utility>

namespace quell {

namespace {

template <class... A>
[[noreturn]] void refuse(const Graph& shown, fmt::format_string<A...> format, A&&... args) {
  throw Error(Exit::usage,
              fmt::format("the preview graph '{}' {}", shown.name, fmt::format(format, std::forward<A>(args)...)));
}

void check_preview(const GraphOutput& output, const Graph& shown) {
  if (shown.inputs.size() != 1 || shown.inputs[0].name != "image") {
    for (const auto& in : shown.inputs)
      if (in.name != "image") refuse(shown, "reads '{}', but a preview has one input, 'image'", in.name);
    refuse(shown, "does not read its input 'image'");
  }
  if (shown.inputs[0].type != output.type)
    refuse(shown, "takes 'image' as {}, but the output '{}' is {}", type_name(shown.inputs[0].type), output.name,
           type_name(output.type));
  if (shown.outputs.empty() || shown.outputs[0].type != QUELL_DISPLAY)
    refuse(shown, "must give an output of type display first");
  for (const auto& node : shown.nodes)
    for (const auto& port : node.in)
      for (const auto& wire : port)
        if (wire.delay > 0)
          refuse(shown, "keeps history in '{}': a preview must not, or it would be part of a run's state", node.name);
}

}  // namespace

void add_preview(Graph& graph, int output, Graph shown) {
  check_preview(graph.outputs[std::size_t(output)], shown);
  const Wire image = graph.outputs[std::size_t(output)].wire;
  const std::string name = graph.outputs[std::size_t(output)].name;
  const int first = int(graph.nodes.size());
  const auto joined = [&](const Wire& w) {
    return w.from.node == Source::kInput ? image : Wire{{w.from.node + first, w.from.port}, 0, {}};
  };
  const Wire picture = joined(shown.outputs[0].wire);
  for (auto& node : shown.nodes) {
    node.name = fmt::format("{}.preview.{}", name, node.name);
    node.preview = true;
    for (auto& port : node.in)
      for (auto& wire : port) wire = joined(wire);
    graph.nodes.push_back(std::move(node));
  }
  graph.outputs.push_back({name, picture, QUELL_DISPLAY, true, output});
}

}  // namespace quell
