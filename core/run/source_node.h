// The node that a sequence names in place of files, made ready: its type found, its parameters checked and set.
#pragma once

#include "core/json/json.h"
#include "core/plugin/registry.h"
#include "core/report/diagnostics.h"
#include "core/sequence/sequence.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace quell {

// Parameters set over those of the sequence, and where they stand in messages: "sequences[0].source.".
struct SourceParameters {
  std::span<const JsonMember> set;
  std::string where;
};

// The type of a source node; reports when there is none.
const NodeType* source_type(const SourceNode&, Registry&, Diagnostics&);

// `graphs` is the folder that "quell:…" means.
std::optional<Instance> source_instance(const SourceNode&, const SourceParameters& over, Registry&,
                                        const std::filesystem::path& graphs, Diagnostics&);

}  // namespace quell
