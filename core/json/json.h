// JSON with comments that remembers where each value stands, so that every later error can point at it.
#pragma once

#include "core/report/diagnostics.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

struct JsonMember;

struct Json {
  enum class Kind { null, boolean, integer, number, text, list, object };

  Kind kind = Kind::null;
  TextPosition position;
  bool boolean = false;
  std::int64_t integer = 0;  // valid for integer
  double number = 0;         // valid for integer and number
  std::string text;          // decoded
  std::vector<Json> items;
  std::vector<JsonMember> members;  // in the order of the file; keys are distinct

  const Json* find(std::string_view key) const;  // of an object; nullptr when absent or no object
  bool is(Kind k) const { return kind == k; }
  bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
  std::string kind_name() const;  // "an object", "text", "a number"…
  std::string shown() const;      // the value for a message, shortened: 12, "abc", [ … ], { … }
};

struct JsonMember {
  std::string key;
  TextPosition key_position;
  Json value;
};

// Values that no text holds: what stands for what was read somewhere else, at that place.
Json text_json(std::string text, TextPosition);
Json list_json(std::vector<Json> items, TextPosition);
Json object_json(TextPosition);

// Parses one document whose text becomes a source called `name`. Syntax errors, duplicate keys (one message each, 64 at
// most), more than 64 levels or 4 million values and numbers that are not finite are errors; nothing is returned then.
// Bounded: a text of 100 MB of brackets is an error, not a crash. Takes comments and a byte order mark.
std::optional<Json> parse_json(std::string name, std::string text, Diagnostics&);
// The same from a file; a missing or unreadable file is an error, of the kind `unreadable`.
std::optional<Json> parse_json_file(const std::string& path, Diagnostics&, Exit unreadable = Exit::usage);

}  // namespace quell
