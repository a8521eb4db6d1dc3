// --preview: which picture each output gets.
#include "apps/quell/previews.h"

#include "apps/quell/options.h"

#include "core/graph/preview.h"
#include "core/report/error.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <filesystem>
#include <optional>

namespace quell {

namespace fs = std::filesystem;

namespace {

// The graph of previews/<name>.json, of a file, or nothing when there is none of that name.
std::string file_of(const fs::path& previews, const std::string& name) {
  if (name.find('/') != std::string::npos || name.ends_with(".json")) return name;
  const auto file = previews / (name + ".json");
  std::error_code error;
  return fs::exists(file, error) ? file.string() : "";
}

// Those of a type, whose name is the type's, and those that --preview-graph names.
std::string names_for_radiance(const fs::path& previews) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(previews, error), end; !error && it != end; it.increment(error))
    if (const auto name = it->path().stem().string(); name == "radiance" || !type_info(name)) names.push_back(name);
  std::ranges::sort(names);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void PreviewOptions::add_to(CLI::App& app) {
  app.add_flag("--preview", wanted, "Writes a PNG beside each image that an eye can read.");
  app.add_option(
         "--preview-graph", graph,
         "How previews show radiance: an installed graph (radiance, exposed, ocio) or a file. Implies --preview.")
      ->type_name("GRAPH");
  repeatable(app.add_option("--preview-set", set, "Sets a parameter of that graph, as in stops=2. Implies --preview."))
      ->type_name("NAME=VALUE");
}

void add_previews(Graph& graph, const PreviewOptions& options, Commander& commander) {
  if (!options.wanted && options.graph.empty() && options.set.empty()) return;
  const auto previews = commander.locations().graphs / "previews";
  const int outputs = int(graph.outputs.size());
  for (int i = 0; i < outputs; ++i) {
    const auto output = graph.outputs[std::size_t(i)];
    const bool radiance = output.type == QUELL_RADIANCE;
    if (output.type == QUELL_DISPLAY) {  // is a picture
      graph.outputs.push_back({output.name, output.wire, QUELL_DISPLAY, true, i});
      continue;
    }
    GraphRequest request;
    request.graph =
        file_of(previews, radiance && !options.graph.empty() ? options.graph : std::string(type_name(output.type)));
    request.graphs = commander.locations().graphs;
    if (request.graph.empty() && radiance && !options.graph.empty())
      throw Error(Exit::usage,
                  fmt::format("--preview-graph {}: there is no such preview\n  installed are: {}; others are "
                              "files, named with their folder or with .json",
                              options.graph, names_for_radiance(previews)));
    if (request.graph.empty()) continue;
    if (radiance)
      for (const auto& text : options.set) request.edits.push_back({Edit::Kind::set, text});
    auto shown = load_graph(request, commander.registry(), commander.diagnostics());
    if (!shown) return;
    add_preview(graph, i, std::move(*shown));
  }
}

}  // namespace quell
