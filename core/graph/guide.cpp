// A graph in words.
#include "core/graph/guide.h"

#include "core/plugin/document.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>

namespace quell {

std::string guide_markdown(const GraphInfo& info, const Graph& graph) {
  const std::string name = std::filesystem::path(info.file).stem().string();
  std::string out =
      fmt::format("## {}\n\n**{}.** {}\n\n![{}](images/graphs/{}.svg)\n", name, info.name, info.about, info.name, name);
  out += "\n| input | type |\n|---|---|\n";
  for (const auto& input : info.inputs)
    out += fmt::format("| `{}` | {}{} |\n", input.name, type_name(input.type), input.optional ? ", optional" : "");
  if (!info.params.empty()) out += "\n| parameter | takes | default | | feeds |\n|---|---|---|---|---|\n";
  for (const auto& p : info.params)
    out += fmt::format("| `{}` | {} | `{}` | {} | {} |\n", p.name, markdown_cell(p.takes), markdown_cell(p.value),
                       markdown_cell(p.doc), fmt::join(p.feeds, ", "));
  std::vector<std::string> outputs;
  for (const auto& output : graph.outputs)
    outputs.push_back(fmt::format("`{}` ({})", output.name, type_name(output.type)));
  std::set<std::string> types;
  for (const auto& node : graph.nodes) types.insert(fmt::format("[{0}](nodes.md#{0})", node.type().name()));
  out += fmt::format("\nGives {}. Made of {}: {}.\n", fmt::join(outputs, ", "),
                     graph.nodes.size() == 1 ? "one node" : fmt::format("{} nodes", graph.nodes.size()),
                     fmt::join(types, ", "));
  return out;
}

}  // namespace quell
