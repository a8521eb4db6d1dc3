// The keys of sequence and profile files, checked: what both have in common.
#pragma once

#include "core/sequence/sequence.h"

#include <span>
#include <string>
#include <string_view>

namespace quell {

// A document being read: its diagnostics, and what files' names are relative to.
struct DocumentContext {
  Diagnostics& diagnostics;
  std::filesystem::path folder;
};

// Reports keys that are not among `known`, with the nearest that is.
void check_keys(const Json& object, const std::string& path, std::span<const std::string> known, Diagnostics&);
// The member, when it is there and of this kind; reports it when it is of another.
const Json* member(const Json& object, std::string_view key, Json::Kind kind, const std::string& path, Diagnostics&);
// "a.b" of "a" and "b".
std::string joined(const std::string& path, std::string_view key);

// One entry of "inputs": a file's name, or an object. In a profile (`profile`) the file may be left out, and an entry
// may be a list of choices. Nothing is returned when the entry is wrong.
std::optional<SequenceInput> parse_input(const std::string& role, const Json&, const std::string& path, bool profile,
                                         DocumentContext&);

}  // namespace quell
