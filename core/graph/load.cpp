// The stages, one after the other.
#include "core/graph/load.h"

#include "core/graph/check.h"
#include "core/graph/expand.h"
#include "core/graph/flatten.h"
#include "core/graph/order.h"
#include "core/graph/resolve.h"
#include "core/plugin/document.h"
#include "core/report/suggest.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

std::string value_text(const Json& json) {
  if (!json.is(Json::Kind::list)) return json.shown();
  std::vector<std::string> items;
  for (const auto& item : json.items) items.push_back(value_text(item));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

void describe(const Document& document, const Expansion* expansion, const Resolved* resolved, GraphInfo& info) {
  info = {document.file, document.name, document.about, document.metric, {}, {}, {}};
  for (const auto& in : document.inputs) info.inputs.push_back({in.name, in.type, in.optional});
  for (const auto& out : document.outputs) info.outputs.push_back(out.name);
  for (std::size_t i = 0; i < document.params.size(); ++i) {
    const auto& value = expansion ? expansion->scopes[0].params[i].json : document.params[i].value;
    info.params.push_back({document.params[i].name, value_text(value), {}, "", ""});
  }
  if (!resolved) return;
  for (const auto& feed : resolved->feeds) {
    auto& p = info.params[std::size_t(feed.param)];
    const auto& param = feed.type->params()[std::size_t(feed.type_param)];
    if (p.feeds.empty()) p.takes = takes(param), p.doc = param.doc;
    p.feeds.push_back(fmt::format("{}.{}", feed.node, param.name));
  }
}

void check_roles(const Graph& graph, const Net& net, const Roles& roles, Faults& faults) {
  std::vector<std::string> names;
  for (const auto& [name, type] : roles) names.push_back(name);
  for (const auto& in : graph.inputs) {
    const auto declared = std::ranges::find(net.inputs, in.name, &NetInput::name);
    const TextPosition position = declared->position;
    const auto role = roles.find(in.name);
    if (role == roles.end())
      faults.error(position, "inputs." + in.name, fmt::format("the sequence has no '{}'", in.name),
                   {possibilities("it has", in.name, names)});
    else if (role->second != in.type)
      faults.error(position, "inputs." + in.name,
                   fmt::format("the sequence gives '{}' as {}, but the graph takes {}", in.name,
                               type_name(role->second), type_name(in.type)));
  }
}

}  // namespace

std::vector<std::string> installed_graphs(const std::filesystem::path& graphs) {
  Diagnostics none;
  Faults faults(none);
  return Library(graphs, faults).names();
}

std::optional<Graph> load_graph(const GraphRequest& request, Registry& registry, Diagnostics& diagnostics,
                                GraphInfo* info) {
  Faults faults(diagnostics);
  Library library(request.graphs, faults);
  const std::size_t errors_before = diagnostics.errors();
  const Edits edits = parse_edits(request.edits, faults);
  const Document* document = library.open_root(request.graph, request.text, request.laid_over);
  if (document && info) describe(*document, nullptr, nullptr, *info);
  if (!document || diagnostics.errors() != errors_before) return std::nullopt;

  auto expansion = expand(*document, edits.changes, library, faults);
  if (!expansion || diagnostics.errors() != errors_before) return std::nullopt;
  auto resolved = resolve(*expansion, edits.taps, request.roles, registry, library, faults);
  if (info) describe(*document, &*expansion, resolved ? &*resolved : nullptr, *info);
  if (!resolved) return std::nullopt;

  Net& net = resolved->net;
  flatten(net, faults);
  if (!faults.ok()) return std::nullopt;
  drop_absent(net);
  check(net, request.roles, faults);
  if (!faults.ok()) return std::nullopt;
  const auto kept = needed(net, faults);
  const auto ordered = order(net, kept, faults);
  if (!faults.ok()) return std::nullopt;
  const auto declared = net.inputs;
  Graph graph = assemble(std::move(net), ordered);
  graph.name = document->name;
  graph.about = document->about;
  if (request.roles) {
    Net inputs;
    inputs.inputs = declared;
    check_roles(graph, inputs, *request.roles, faults);
    if (!faults.ok()) return std::nullopt;
  }
  return graph;
}

}  // namespace quell
