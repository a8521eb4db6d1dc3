// By the names that an input gives, or else by those that are usual for its type.
#include "core/sequence/channels.h"

#include "core/report/suggest.h"
#include "core/sequence/profile.h"
#include "core/sequence/role.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

// Y is gray only where it is alone: beside X and Z it is an axis, beside RY and BY it has lost its hue.
bool may_be_gray(int type) { return type == QUELL_RADIANCE || type == QUELL_ALBEDO; }

}  // namespace

std::vector<std::string> find_channels(const std::vector<std::string>& names, const ChannelChoice& choice, int type) {
  if (!choice.channels.empty()) {
    const auto layer = layer_with(names, choice.channels, choice.layered);
    std::vector<std::string> out;
    if (layer)
      for (const auto& channel : choice.channels) out.push_back(*layer + channel);
    return out;
  }
  for (const auto& usual : usual_channels(type))
    if (layer_with(names, usual, false)) return usual;
  if (may_be_gray(type) && (names == std::vector<std::string>{"Y"} || names == std::vector<std::string>{"Y", "A"}))
    return {"Y", "Y", "Y"};
  // A lone channel can only be what is asked for.
  return names.size() == 1 && type_info(type)->channels == 1 ? names : std::vector<std::string>();
}

void report_channels(const SequenceInput& input, const std::string& path, const std::vector<std::string>& names,
                     Diagnostics& diagnostics) {
  const auto& choice = input.choices.front();
  for (const auto& channel : choice.channels)
    if (std::ranges::find(names, channel) == names.end())
      diagnostics.error(choice.position, input.where, fmt::format("'{}' has no channel '{}'", path, channel),
                        {possibilities("it has", channel, names)});
  if (choice.channels.empty()) {
    std::vector<std::string> usual;
    for (const auto& u : usual_channels(input.type)) usual.push_back(fmt::format("{}", fmt::join(u, " ")));
    if (may_be_gray(input.type)) usual.emplace_back("Y alone");
    diagnostics.error(
        input.position, input.where,
        fmt::format("'{}' has no channels by the usual names of {}", path, type_name(input.type)),
        {fmt::format("usual names: {}", fmt::join(usual, ", ")), possibilities("it has", "", names),
         input.where.empty() ? "name them in a sequence file, with \"channels\"" : "name them with \"channels\""});
  }
}

}  // namespace quell
