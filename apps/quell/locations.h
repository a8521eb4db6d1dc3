// Where the program finds its plugins and data: beside itself, in an installed prefix as in a build tree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quell {

struct Locations {
  std::vector<std::filesystem::path> plugins;  // searched in order: --plugins, $QUELL_PLUGINS, those beside the program
  std::filesystem::path graphs;  // installed graphs; parts, profiles, scenes and sequences are folders in it
};

// `extra` folders come first. $QUELL_PLUGINS is a list separated by colons; $QUELL_GRAPHS replaces the folder of
// graphs.
Locations find_locations(const std::vector<std::string>& extra);

}  // namespace quell
