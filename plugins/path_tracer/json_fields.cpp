// Checked access to JSON.
#include "path_tracer/json_fields.h"

#include <cstdio>
#include <set>
#include <stdexcept>

namespace path_tracer {

namespace {

const Json kNoArray = Json::array(), kNoObject = Json::object();

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string shown(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

std::string listed(std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::string described(const Range& range) {
  if (range.min > -kInfinite && range.max < kInfinite) return "from " + shown(range.min) + " to " + shown(range.max);
  return range.min > -kInfinite ? "at least " + shown(range.min) : "at most " + shown(range.max);
}

}  // namespace

void Problems::add(const std::string& where, const std::string& text) { lines_.push_back(where + ": " + text); }

void Problems::raise() const {
  constexpr std::size_t kSpelled = 6;
  if (lines_.empty()) return;
  std::string text;
  for (std::size_t i = 0; i < std::min(lines_.size(), kSpelled); ++i)
    text += (i ? "\n" : "") + file_ + ": " + lines_[i];
  if (lines_.size() > kSpelled) text += "\n" + file_ + ": and " + std::to_string(lines_.size() - kSpelled) + " more";
  throw std::runtime_error(text);
}

Fields::Fields(const Json& json, std::string where, Problems& problems, std::initializer_list<const char*> known)
    : object_(&json), where_(std::move(where)), problems_(&problems) {
  if (!json.is_object()) {
    problems.add(where_.empty() ? "the file" : where_, shown(json) + " is not an object");
    object_ = &kNoObject;
  }
  for (const auto& [key, value] : object_->items()) {
    bool found = false;
    for (const char* name : known) found |= key == name;
    if (!found) problems.add(place(key), "unknown key; known here: " + listed(known));
  }
}

const Json* Fields::find(const char* key) const {
  const auto it = object_->find(key);
  return it == object_->end() ? nullptr : &*it;
}

const Json* Fields::require(const char* key) const {
  const Json* json = find(key);
  if (!json) problem(key, "missing");
  return json;
}

double Fields::as_number(const Json& json, const std::string& where, Range range, Problems& problems) {
  if (!json.is_number()) {
    problems.add(where, shown(json) + " is not a number");
    return std::clamp(1.0, range.min, range.max);
  }
  const double value = json.get<double>();
  if (std::isfinite(value) && value >= range.min && value <= range.max) return value;
  problems.add(where, shown(json) + " is out of range; it must be " + described(range));
  return std::clamp(1.0, range.min, range.max);
}

Vec Fields::as_vector(const Json& json, const std::string& where, Range range, Problems& problems) {
  if (!json.is_array() || json.size() != 3) {
    problems.add(where, shown(json) + " is not an array of 3 numbers");
    return Vec(0);
  }
  Vec v;
  for (int i = 0; i < 3; ++i) {
    const auto at = std::size_t(i);
    v[i] = as_number(json[at], where + "[" + std::to_string(i) + "]", range, problems);
  }
  return v;
}

double Fields::number(const char* key, Range range) const {
  const Json* json = require(key);
  return json ? as_number(*json, place(key), range, *problems_) : std::clamp(1.0, range.min, range.max);
}
double Fields::number(const char* key, Range range, double fallback) const {
  const Json* json = find(key);
  return json ? as_number(*json, place(key), range, *problems_) : fallback;
}
int Fields::integer(const char* key, int min, int max, int fallback) const {
  const Json* json = find(key);
  if (!json) return fallback;
  if (!json->is_number_integer()) {
    problem(key, shown(*json) + " is not a whole number");
    return fallback;
  }
  return int(as_number(*json, place(key), {double(min), double(max)}, *problems_));
}
bool Fields::flag(const char* key, bool fallback) const {
  const Json* json = find(key);
  if (!json) return fallback;
  if (!json->is_boolean()) problem(key, shown(*json) + " is not true or false");
  return json->is_boolean() ? json->get<bool>() : fallback;
}
std::string Fields::text(const char* key) const {
  const Json* json = require(key);
  if (json && json->is_string()) return json->get<std::string>();
  if (json) problem(key, shown(*json) + " is not a string");
  return {};
}
int Fields::choice(const char* key, std::initializer_list<const char*> names) const {
  if (const Json* json = require(key)) {
    int i = 0;
    for (const char* name : names) {
      if (*json == name) return i;
      ++i;
    }
    problem(key, shown(*json) + " is not one of: " + listed(names));
  }
  return -1;
}
int Fields::choice(const char* key, std::initializer_list<const char*> names, int fallback) const {
  return has(key) ? choice(key, names) : fallback;
}
Vec Fields::vector(const char* key, Range range) const {
  const Json* json = require(key);
  return json ? as_vector(*json, place(key), range, *problems_) : Vec(0);
}
Vec Fields::vector(const char* key, Range range, const Vec& fallback) const {
  const Json* json = find(key);
  return json ? as_vector(*json, place(key), range, *problems_) : fallback;
}
const Json& Fields::array(const char* key) const {
  const Json* json = require(key);
  if (json && json->is_array()) return *json;
  if (json) problem(key, shown(*json) + " is not an array");
  return kNoArray;
}
const Json& Fields::object(const char* key) const {
  const Json* json = require(key);
  if (json && json->is_object()) return *json;
  if (json) problem(key, shown(*json) + " is not an object");
  return kNoObject;
}

Json parse_json(std::string_view text, const std::string& file) {
  std::vector<std::set<std::string>> keys;
  std::string twice;
  const auto note = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second && twice.empty())
      twice = value.get<std::string>();
    return true;
  };
  Json json;
  try {
    json = Json::parse(text.begin(), text.end(), note, true, true);
  } catch (const Json::parse_error& e) {
    std::size_t line = 1, start = 0;
    const std::size_t at = std::min(e.byte ? e.byte - 1 : 0, text.size());
    for (std::size_t i = 0; i < at; ++i)
      if (text[i] == '\n') ++line, start = i + 1;
    std::string reason = e.what();
    if (const auto colon = reason.rfind(": ");
        colon != std::string::npos && reason.find("parse error") != std::string::npos)
      reason = reason.substr(reason.find("column") != std::string::npos ? reason.find(": ") + 2 : 0);
    throw std::runtime_error(file + ":" + std::to_string(line) + ":" + std::to_string(at - start + 1) +
                             ": not valid JSON: " + reason);
  }
  if (!twice.empty()) throw std::runtime_error(file + ": key '" + twice + "' stands twice in one object; remove one");
  return json;
}

}  // namespace path_tracer
