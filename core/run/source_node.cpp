// The node that a sequence names in place of files.
#include "core/run/source_node.h"

#include "core/graph/params.h"
#include "core/report/suggest.h"

#include <fmt/format.h>

#include <vector>

namespace quell {

const NodeType* source_type(const SourceNode& source, Registry& registry, Diagnostics& diagnostics) {
  if (const auto* type = registry.find(source.type)) return type;
  if (const auto* problem = registry.problem(source.type))
    diagnostics.error(source.position, "source.type", fmt::format("the plugin of '{}' cannot be used", source.type),
                      {fmt::format("{}: {}", problem->file.string(), problem->text)}, Exit::plugin);
  else
    diagnostics.error(source.position, "source.type", fmt::format("there is no node type '{}'", source.type),
                      {possibilities("there are", source.type, registry.names())});
  return nullptr;
}

std::optional<Instance> source_instance(const SourceNode& source, const SourceParameters& over, Registry& registry,
                                        const std::filesystem::path& graphs, Diagnostics& diagnostics) {
  const auto* type = source_type(source, registry, diagnostics);
  if (!type) return std::nullopt;
  const std::size_t before = diagnostics.errors();
  Instance instance(*type);
  Faults faults(diagnostics);
  const Library library(graphs, faults);
  const auto set = [&](const JsonMember& member, const std::string& where) {
    const int param = type->find_param(member.key);
    if (param < 0) {
      diagnostics.error(member.value.position, where + member.key,
                        fmt::format("node type '{}' has no parameter '{}'", type->name(), member.key),
                        {possibilities("it has", member.key, names_of(type->params()))});
      return;
    }
    if (auto problem = assign(instance, param, member.value, true, library); !problem.text.empty())
      diagnostics.error(member.value.position, where + member.key, problem.text, problem.notes);
  };
  if (source.set)
    for (const auto& member : source.set->members) set(member, "source.set.");
  for (const auto& member : over.set) set(member, over.where);
  if (diagnostics.errors() != before) return std::nullopt;
  // Defaults may name installed files too.
  for (std::size_t p = 0; p < type->params().size(); ++p)
    if (type->params()[p].kind == QUELL_PATH)
      if (const auto file = library.installed(std::string(instance.get_text(int(p)))))
        instance.set_text(int(p), file->string());
  return instance;
}

}  // namespace quell
