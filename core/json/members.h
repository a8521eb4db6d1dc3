// Objects by the rules that all of this program's files follow: what kind of document one is, and its keys.
#pragma once

#include "core/json/json.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace quell {

// Whether a document is of the kind that begins with `key`: 1, and which messages call `what`: "a study". Reports it
// when it is not.
bool is_document(const Json&, std::string_view key, std::string_view what, Diagnostics&);

// Reports keys that are not among `known`, with the nearest that is.
void check_keys(const Json& object, const std::string& path, std::span<const std::string> known, Diagnostics&);
// The member, when it is there and of this kind; reports it when it is of another.
const Json* member(const Json& object, std::string_view key, Json::Kind kind, const std::string& path, Diagnostics&);
// What it says, by the same rules.
std::optional<std::string> text_member(const Json& object, std::string_view key, const std::string& path, Diagnostics&);
// "a.b" of "a" and "b".
std::string joined(const std::string& path, std::string_view key);

}  // namespace quell
