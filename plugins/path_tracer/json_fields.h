// Reads JSON objects field by field and collects what is wrong, so that one run reports every problem of a file.
#pragma once

#include "path_tracer/math.h"

#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace path_tracer {

using Json = nlohmann::json;
inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}
  void add(const std::string& where, const std::string& text);
  // Throws std::runtime_error if there were any; the first few are spelled out, as an error's text is bounded.
  void raise() const;

 private:
  std::string file_;
  std::vector<std::string> lines_;
};

struct Range {
  double min = -kInfinite, max = kInfinite;
};

// One JSON object. A getter returns its fallback, or zero, after a problem has been noted.
class Fields {
 public:
  Fields(const Json& json, std::string where, Problems& problems, std::initializer_list<const char*> known);

  bool has(const char* key) const { return object_->contains(key); }
  double number(const char* key, Range range) const;
  double number(const char* key, Range range, double fallback) const;
  int integer(const char* key, int min, int max, int fallback) const;
  bool flag(const char* key, bool fallback) const;
  std::string text(const char* key) const;
  // Index of the value among `names`.
  int choice(const char* key, std::initializer_list<const char*> names, int fallback) const;
  int choice(const char* key, std::initializer_list<const char*> names) const;
  Vec vector(const char* key, Range range = {}) const;
  Vec vector(const char* key, Range range, const Vec& fallback) const;
  // An array or object; an empty one after a problem.
  const Json& array(const char* key) const;
  const Json& object(const char* key) const;
  const Json* find(const char* key) const;

  void problem(const char* key, const std::string& text) const { problems_->add(place(key), text); }
  std::string place(const std::string& key) const { return where_.empty() ? key : where_ + "." + key; }
  Problems& problems() const { return *problems_; }

  static Vec as_vector(const Json&, const std::string& where, Range, Problems&);
  static double as_number(const Json&, const std::string& where, Range, Problems&);

 private:
  const Json* require(const char* key) const;

  const Json* object_;
  std::string where_;
  Problems* problems_;
};

// Parses text that may hold comments. Throws with line and column, or naming a key that one object has twice.
Json parse_json(std::string_view text, const std::string& file);

}  // namespace path_tracer
