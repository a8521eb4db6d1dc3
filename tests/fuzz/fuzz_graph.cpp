// Any text is a graph or gives errors that can be shown, with any edits behind it. A graph that loads can be planned or
// is refused in words.
//
// Input: a document, then edits as on the command line, each after a NUL and a letter for its kind. Node types are
// those of the folder QUELL_TEST_PLUGINS, where there are some.
#include "tests/fuzz/registry.h"

#include "core/graph/load.h"
#include "core/report/error.h"
#include "core/run/plan.h"

#include <quell/types.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace {

using quell::Edit;

std::vector<Edit> edits_of(std::string_view text) {
  std::vector<Edit> edits;
  while (!text.empty()) {
    const auto end = text.find('\0');
    const auto edit = text.substr(0, end);
    text = end == text.npos ? std::string_view() : text.substr(end + 1);
    if (edit.empty()) continue;
    constexpr Edit::Kind kinds[] = {Edit::Kind::set, Edit::Kind::swap, Edit::Kind::wire, Edit::Kind::bypass,
                                    Edit::Kind::tap};
    edits.push_back({kinds[static_cast<unsigned char>(edit[0]) % 5], std::string(edit.substr(1))});
  }
  return edits;
}

void plan(const quell::Graph& graph) {
  std::vector<quell_shape> shapes;
  for (const auto& input : graph.inputs) {
    const auto* info = quell::type_info(input.type);
    const bool table = info && info->storage == quell::Storage::table;
    shapes.push_back({table ? 16 : 9, table ? 2 : 7, info && info->channels ? info->channels : 4});
  }
  try {
    if (quell::Plan(graph, shapes).describe().empty()) std::abort();
  } catch (const quell::Error& e) {
    if (std::string_view(e.what()).empty()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto end = text.find('\0');
  quell::GraphRequest request;
  request.graph = QUELL_FUZZ_GRAPHS "/input.json";
  request.graphs = QUELL_FUZZ_GRAPHS;
  request.text = std::string(text.substr(0, end));
  if (end != text.npos) request.edits = edits_of(text.substr(end + 1));
  quell::Diagnostics diagnostics;
  quell::GraphInfo info;
  const auto graph = quell::load_graph(request, quell::fuzz::registry(), diagnostics, &info);
  if (graph.has_value() != diagnostics.ok()) std::abort();
  if (!graph && diagnostics.format().empty()) std::abort();
  if (!graph) return 0;
  if (quell::fingerprint(*graph).size() != 16) std::abort();
  plan(*graph);
  return 0;
}
