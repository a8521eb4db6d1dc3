// What is wrong with an object is said of the member that is wrong.
#include "core/json/members.h"

#include "core/report/suggest.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

std::string kind_name(Json::Kind kind) {
  Json json;
  json.kind = kind;
  return json.kind_name();
}

}  // namespace

bool is_document(const Json& json, std::string_view key, std::string_view what, Diagnostics& diagnostics) {
  if (!json.is(Json::Kind::object)) {
    diagnostics.error(json.position, "", fmt::format("{} is an object, not {}", what, json.shown()));
    return false;
  }
  const Json* version = json.find(key);
  if (version && version->is(Json::Kind::integer) && version->integer == 1) return true;
  if (version)
    diagnostics.error(version->position, std::string(key),
                      fmt::format("version {} is not known; this program reads version 1", version->shown()));
  else
    diagnostics.error(json.position, "", fmt::format("{} begins with \"{}\": 1", what, key));
  return false;
}

void check_keys(const Json& object, const std::string& path, std::span<const std::string> known,
                Diagnostics& diagnostics) {
  for (const auto& m : object.members) {
    if (std::ranges::find(known, m.key) != known.end()) continue;
    diagnostics.error(m.key_position, path, fmt::format("unknown key '{}'", m.key),
                      {possibilities("possible keys", m.key, known)});
  }
}

const Json* member(const Json& object, std::string_view key, Json::Kind kind, const std::string& path,
                   Diagnostics& diagnostics) {
  const Json* json = object.find(key);
  if (!json) return nullptr;
  if (json->is(kind) || (kind == Json::Kind::number && json->is_number())) return json;
  diagnostics.error(json->position, joined(path, key),
                    fmt::format("must be {}, not {}", kind_name(kind), json->shown()));
  return nullptr;
}

std::optional<std::string> text_member(const Json& object, std::string_view key, const std::string& path,
                                       Diagnostics& diagnostics) {
  const Json* json = member(object, key, Json::Kind::text, path, diagnostics);
  return json ? std::optional(json->text) : std::nullopt;
}

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

}  // namespace quell
