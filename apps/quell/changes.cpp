// Versions are compared word by word, files by their hashes.
#include "apps/quell/changes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace quell {

namespace {

std::vector<std::string> split(const std::string& text, std::string_view between) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find(between, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + between.size();
  }
  return parts;
}

}  // namespace

std::vector<std::string> changes_of_program(const Recorded& then, const std::string& plugins, const Graph& graph) {
  std::vector<std::string> changes;
  if (then.version != QUELL_VERSION) changes.push_back(fmt::format("Quell was {}, now " QUELL_VERSION, then.version));
  const auto before = split(then.plugins, ", "), after = split(plugins, ", ");
  for (const auto& plugin : before) {
    if (std::ranges::find(after, plugin) != after.end()) continue;
    const auto name = plugin.substr(0, plugin.find(' ') + 1);
    const auto now = std::ranges::find_if(after, [&](const auto& p) { return p.starts_with(name); });
    changes.push_back(now == after.end() ? fmt::format("plugin {} had a part in it", plugin)
                                         : fmt::format("plugin {} was there, now {}", plugin, *now));
  }
  if (changes.empty() && then.fingerprint != fingerprint(graph))
    changes.push_back(fmt::format("the graph's fingerprint was {}, now {}", then.fingerprint, fingerprint(graph)));
  return changes;
}

std::vector<std::string> changes_of_files(const Recorded& then, const Provenance& now,
                                          const std::vector<std::string>& history) {
  std::vector<std::string> changes;
  const auto files = now.files(then.frame);
  for (const auto& [name, hash] : then.inputs) {
    const auto it = files.find(name);
    if (it == files.end())
      changes.push_back(fmt::format("frame {}: {} was read then", then.frame, name));
    else if (it->second != hash)
      changes.push_back(fmt::format("frame {}: {} has changed", then.frame, name));
  }
  for (const auto& [name, hash] : files)
    if (!then.inputs.contains(name)) changes.push_back(fmt::format("frame {}: {} was not read then", then.frame, name));
  for (std::size_t i = 0; i < std::min(history.size(), then.history.size()); ++i) {
    if (history[i] == then.history[i]) continue;
    const auto frame = then.first + std::int64_t(i);
    std::vector<std::string> names;
    for (const auto& [name, hash] : now.files(frame)) names.push_back(name);
    changes.push_back(fmt::format("frame {}: {}{}", frame, fmt::join(names, ", "),
                                  names.size() == 1 ? " has changed" : ": one of these has changed"));
  }
  return changes;
}

}  // namespace quell
