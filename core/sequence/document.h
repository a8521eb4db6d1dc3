// The entries of "inputs" in sequence and profile files, checked: what both have in common.
#pragma once

#include "core/json/json.h"
#include "core/sequence/sequence.h"

#include <string>

namespace quell {

// A document being read: its diagnostics, and what files' names are relative to.
struct DocumentContext {
  Diagnostics& diagnostics;
  std::filesystem::path folder;
};

// One entry of "inputs": a file's name, or an object. In a profile (`profile`) the file may be left out, and an entry
// may be a list of choices. Nothing is returned when the entry is wrong.
std::optional<SequenceInput> parse_input(const std::string& role, const Json&, const std::string& path, bool profile,
                                         DocumentContext&);

}  // namespace quell
