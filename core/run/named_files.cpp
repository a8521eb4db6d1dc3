// Paths are absolute once a graph or source has been loaded.
#include "core/run/named_files.h"

#include "core/sequence/file_hash.h"

#include <fmt/format.h>

#include <filesystem>

namespace quell {

std::map<std::string, std::string> named_files(const std::string& node, const Instance& instance) {
  std::map<std::string, std::string> files;
  const auto params = instance.type().params();
  for (std::size_t p = 0; p < params.size(); ++p) {
    if (params[p].kind != QUELL_PATH) continue;
    const std::string path(instance.get_text(int(p)));
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error))
      files[fmt::format("{}.{}", node, params[p].name)] = file_hash(path);
  }
  return files;
}

}  // namespace quell
