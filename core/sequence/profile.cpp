// Reads profiles: {"quell_profile": 1, "about", "detect": {"channels", "layered", "files"}, "inputs": {role: entry or
// entries}}.
#include "core/sequence/profile.h"

#include "core/json/members.h"
#include "core/sequence/document.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

std::optional<std::string> layer_with(std::span<const std::string> names, std::span<const std::string> wanted,
                                      bool layered) {
  const auto all = [&](const std::string& layer) {
    return std::ranges::all_of(
        wanted, [&](const std::string& w) { return std::ranges::find(names, layer + w) != names.end(); });
  };
  if (wanted.empty()) return std::nullopt;
  if (all("")) return "";
  if (!layered) return std::nullopt;
  for (const auto& name : names) {
    if (!name.ends_with("." + wanted[0])) continue;
    std::string layer = name.substr(0, name.size() - wanted[0].size());
    if (all(layer)) return layer;
  }
  return std::nullopt;
}

std::vector<std::string> profile_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator(folder, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (entry->path().extension() == ".json") names.push_back(entry->path().stem().string());
  std::ranges::sort(names);
  return names;
}

namespace {

std::vector<std::string> texts(const Json& object, const char* key, const std::string& path, Diagnostics& diagnostics) {
  std::vector<std::string> out;
  const Json* list = member(object, key, Json::Kind::list, path, diagnostics);
  if (!list) return out;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const Json& item = list->items[i];
    if (item.is(Json::Kind::text)) {
      out.push_back(item.text);
    } else {
      diagnostics.error(item.position, fmt::format("{}.{}[{}]", path, key, i),
                        fmt::format("must be text, not {}", item.shown()));
    }
  }
  return out;
}

}  // namespace

std::optional<Profile> load_profile(const std::filesystem::path& folder, const std::string& name,
                                    Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errors();
  const auto document = parse_json_file((folder / (name + ".json")).string(), diagnostics);
  if (!document || !is_document(*document, "quell_profile", "a profile", diagnostics)) return std::nullopt;
  const std::vector<std::string> keys = {"quell_profile", "about", "detect", "inputs"};
  check_keys(*document, "", keys, diagnostics);
  Profile profile;
  profile.name = name;
  if (const Json* about = member(*document, "about", Json::Kind::text, "", diagnostics)) profile.about = about->text;
  if (const Json* detect = member(*document, "detect", Json::Kind::object, "", diagnostics)) {
    const std::vector<std::string> detect_keys = {"channels", "layered", "files"};
    check_keys(*detect, "detect", detect_keys, diagnostics);
    profile.channels = texts(*detect, "channels", "detect", diagnostics);
    profile.files = texts(*detect, "files", "detect", diagnostics);
    if (const Json* layered = member(*detect, "layered", Json::Kind::boolean, "detect", diagnostics))
      profile.layered = layered->boolean;
  }
  DocumentContext context{diagnostics, {}};
  if (const Json* inputs = member(*document, "inputs", Json::Kind::object, "", diagnostics)) {
    for (const auto& m : inputs->members) {
      auto input = parse_input(m.key, m.value, joined("inputs", m.key), true, context);
      if (!input) continue;
      for (auto& choice : input->choices) choice.layered = profile.layered;
      profile.inputs.push_back(std::move(*input));
    }
  }
  if (diagnostics.errors() != before) return std::nullopt;
  return profile;
}

}  // namespace quell
