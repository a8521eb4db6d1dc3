// What is not as it was when a picture was made.
#pragma once

#include "apps/quell/recorded.h"

#include <string>
#include <vector>

namespace quell {

// Of the program, the plugins (core/run/provenance.h: plugin_versions) and the graph; a sentence each.
std::vector<std::string> changes_of_program(const Recorded& then, const std::string& plugins, const Graph& now);
// Of the files that its frames were made from. `history` is quell:history of the frame made again.
std::vector<std::string> changes_of_files(const Recorded& then, const Provenance& now,
                                          const std::vector<std::string>& history);

}  // namespace quell
