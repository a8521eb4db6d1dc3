// What a renderer calls its channels and files, from a data file.
#pragma once

#include "core/sequence/sequence.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace quell {

struct Profile {
  std::string name;  // of its file, without the extension
  std::string about;
  std::vector<std::string> channels;  // an image with all of these is this renderer's
  bool layered = false;               // with a layer's name and a dot before all of them
  std::vector<std::string> files;     // a folder with files of all these patterns is this renderer's
  std::vector<SequenceInput> inputs;  // files are patterns relative to such a folder, or empty
};

// What stands before all `wanted` channels in `names`: "" as they are, or when `layered` a layer's name with its dot.
std::optional<std::string> layer_with(std::span<const std::string> names, std::span<const std::string> wanted,
                                      bool layered);

// Names of the profiles in a folder, in order.
std::vector<std::string> profile_names(const std::filesystem::path& folder);
std::optional<Profile> load_profile(const std::filesystem::path& folder, const std::string& name, Diagnostics&);

}  // namespace quell
