// The schema accepts good graphs and refuses what an editor should underline. Validated by a small validator of draft
// 7, which knows just the keywords that the schema uses and fails on others.
#include "core/graph/schema.h"

#include "tests/support/graph_nodes.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

namespace quell::test {
namespace {

using J = nlohmann::json;

class Validator {
 public:
  explicit Validator(J schema) : schema_(std::move(schema)) {}
  bool valid(const J& value) const { return valid(schema_, value); }

 private:
  bool valid(const J& s, const J& v) const {
    for (const auto& [key, rule] : s.items())
      if (!keyword(s, key, rule, v)) return false;
    return true;
  }
  int matches(const J& schemas, const J& v) const {
    return int(std::ranges::count_if(schemas, [&](const J& s) { return valid(s, v); }));
  }
  bool keyword(const J& s, const std::string& key, const J& rule, const J& v) const {
    if (key == "$ref") return valid(schema_.at(J::json_pointer(rule.get<std::string>().substr(1))), v);
    if (key == "type") return is(rule, v);
    if (key == "const") return v == rule;
    if (key == "enum") return std::ranges::find(rule, v) != rule.end();
    if (key == "pattern")
      return !v.is_string() || std::regex_search(v.get<std::string>(), std::regex(rule.get<std::string>()));
    if (key == "minimum") return !v.is_number() || v >= rule;
    if (key == "maximum") return !v.is_number() || v <= rule;
    if (key == "minItems") return !v.is_array() || v.size() >= rule;
    if (key == "maxItems") return !v.is_array() || v.size() <= rule;
    if (key == "minProperties") return !v.is_object() || v.size() >= rule;
    if (key == "items") return !v.is_array() || std::ranges::all_of(v, [&](const J& i) { return valid(rule, i); });
    if (key == "anyOf") return matches(rule, v) > 0;
    if (key == "oneOf") return matches(rule, v) == 1;
    if (key == "allOf") return matches(rule, v) == int(rule.size());
    if (key == "not") return !valid(rule, v);
    if (key == "if")
      return valid(rule, v) ? !s.contains("then") || valid(s["then"], v) : !s.contains("else") || valid(s["else"], v);
    if (key == "required")
      return !v.is_object() ||
             std::ranges::all_of(rule, [&](const J& name) { return v.contains(name.get<std::string>()); });
    if (key == "properties" || key == "additionalProperties" || key == "propertyNames") return members(s, key, rule, v);
    const bool silent = key == "then" || key == "else" || key == "description" || key == "default" || key == "title" ||
                        key == "$schema" || key == "definitions";
    EXPECT_TRUE(silent) << key;
    return silent;
  }
  bool members(const J& s, const std::string& key, const J& rule, const J& v) const {
    if (!v.is_object()) return true;
    for (const auto& [name, value] : v.items()) {
      const bool listed = s.contains("properties") && s["properties"].contains(name);
      if (key == "propertyNames" && !valid(rule, name)) return false;
      if (key == "properties" && listed && !valid(rule[name], value)) return false;
      if (key == "additionalProperties" && !listed && (rule.is_boolean() ? !rule.get<bool>() : !valid(rule, value)))
        return false;
    }
    return true;
  }
  static bool is(const J& type, const J& v) {
    if (type.is_array()) return std::ranges::any_of(type, [&](const J& t) { return is(t, v); });
    if (type == "object") return v.is_object();
    if (type == "array") return v.is_array();
    if (type == "string") return v.is_string();
    if (type == "boolean") return v.is_boolean();
    if (type == "null") return v.is_null();
    if (type == "integer") return v.is_number_integer();
    return type == "number" && v.is_number();
  }
  J schema_;
};

const Validator& validator() {
  static const Validator v(J::parse(graph_schema(graph_registry())));
  return v;
}
bool accepts(const std::string& text) { return validator().valid(J::parse(text, nullptr, true, true)); }
std::string graph_of(const std::string& node) {
  return R"({"quell": 1, "inputs": {"color": "radiance"}, "nodes": {"b": )" + node + R"(}, "outputs": {"color": "b"}})";
}

TEST(Schema, AcceptsGoodGraphs) {
  for (const char* name : {"svgf.json", "parts/svgf_level.json"}) {
    std::ifstream file(std::string(QUELL_TEST_SOURCE) + "/tests/core/graphs/" + name);
    EXPECT_TRUE(accepts({std::istreambuf_iterator<char>(file), {}})) << name;
  }
  EXPECT_TRUE(accepts(
      graph_of(R"({"type": "gaussian", "in": {"image": "color@-1"}, "set": {"sigma": "$s", "kernel": "box"}})")));
  EXPECT_TRUE(accepts(
      graph_of(R"({"type": "gaussian", "in": {"image": {"from": "color@-1", "start": "color", "as": "albedo"}}})")));
  EXPECT_TRUE(accepts(
      R"({"quell": 1, "base": "svgf", "nodes": {"b": null, "c": {"set": {"sigma": null}}}, "swap": {"a": "gaussian"},
                          "bypass": ["x"], "set": {"a.b": 1}, "wire": {"a.b": "c", "d.e": null}})"));
}

TEST(Schema, RefusesWhatAnEditorShouldUnderline) {
  EXPECT_FALSE(accepts("{}"));
  EXPECT_FALSE(accepts(R"({"quell": 1})"));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gausian", "in": {"image": "color"}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian"})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {"imge": "color", "image": "color"}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {"image": ["color"]}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {"image": "color@1"}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {"image": "color"}, "set": {"sigma": 1000}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {"image": "color"}, "set": {"radius": 2.5}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {"image": "color"}, "set": {"kernel": "bocks"}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "gaussian", "in": {"image": "color"}, "set": {"sgma": 1}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "grade", "in": {"image": "color"}, "set": {"lift": [0, 1]}})")));
  EXPECT_FALSE(accepts(graph_of(R"({"type": "grade", "in": {"image": "color"}, "set": {"table": "/etc/passwd"}})")));
  EXPECT_FALSE(accepts(R"({"quell": 1, "inputs": {"color": "colour"}, "outputs": {"color": "color"}})"));
  EXPECT_FALSE(accepts(R"({"quell": 1, "inputs": {"color": "radiance"}, "outputs": {"color": "color"}, "swap": {}})"));
}

}  // namespace
}  // namespace quell::test
