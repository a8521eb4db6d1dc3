// Where the program finds its plugins and data.
#include "apps/quell/locations.h"

#include <cstdlib>
#include <sstream>
#include <system_error>

namespace quell {

namespace fs = std::filesystem;

namespace {

// The first folder above the program that holds `below`; "" when there is none.
fs::path beside_program(const fs::path& below) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const fs::path found = program.parent_path().parent_path() / below;
  return fs::is_directory(found, error) ? fs::weakly_canonical(found, error) : fs::path();
}

}  // namespace

Locations find_locations(const std::vector<std::string>& extra) {
  Locations locations;
  for (const auto& folder : extra) locations.plugins.emplace_back(folder);
  if (const char* list = std::getenv("QUELL_PLUGINS")) {
    std::istringstream in(list);
    for (std::string folder; std::getline(in, folder, ':');)
      if (!folder.empty()) locations.plugins.emplace_back(folder);
  }
  if (const auto folder = beside_program(QUELL_PLUGIN_DIR); !folder.empty()) locations.plugins.push_back(folder);
  if (const char* folder = std::getenv("QUELL_GRAPHS"))
    locations.graphs = folder;
  else
    locations.graphs = beside_program(fs::path(QUELL_DATA_DIR) / "graphs");
  return locations;
}

}  // namespace quell
