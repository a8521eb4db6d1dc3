// A sequence as a sequence file: the inverse of load_sequence.
#pragma once

#include "core/plugin/node_type.h"
#include "core/sequence/sequence.h"

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace quell {

// A sequence of files, each input with its first choice of channels: frames, cuts among them, and roles, with an
// absolute root and names below it. What recognised the files, a profile or a document, is no part of it any more.
std::string write_sequence(const Sequence&);
// A sequence that a source node makes, with every parameter spelt out; files below `graphs` are named "quell:…".
std::string write_sequence(const Instance& source, std::span<const std::int64_t> frames,
                           const std::set<std::int64_t>& cuts, const std::filesystem::path& graphs);

// A path as a sequence with this root names it: relative to the root where it lies below it, else absolute.
std::string name_below(const std::filesystem::path& root, const std::string& path);

}  // namespace quell
