// The schema is the registry's tables in other words; what needs the whole graph (types of wires, cycles) stays to
// `check`.
#include "core/graph/schema.h"

#include "core/plugin/document.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace quell {

namespace {

using J = nlohmann::ordered_json;

constexpr const char* kName = "^[a-z][a-z0-9_]*$";
constexpr const char* kDottedName = "^[a-z][a-z0-9_]*(\\.[a-z][a-z0-9_]*)*$";

J ref(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }
J map_of(J values, const std::string& description, const char* name = kName) {
  return {{"type", "object"},
          {"description", description},
          {"propertyNames", {{"pattern", name}}},
          {"additionalProperties", std::move(values)}};
}
// In a variant null removes.
J or_null(J schema) { return {{"anyOf", J::array({std::move(schema), {{"type", "null"}}})}}; }

J number(const quell_param& p, const char* type) {
  J schema{{"type", type}};
  if (std::isfinite(p.min)) schema["minimum"] = p.min;
  if (std::isfinite(p.max)) schema["maximum"] = p.max;
  return schema;
}

J param_values(const quell_param& p) {
  switch (p.kind) {
    case QUELL_BOOL:
      return {{"type", "boolean"}};
    case QUELL_INT:
      return number(p, "integer");
    case QUELL_FLOAT:
      return number(p, "number");
    case QUELL_CHOICE:
      return {{"enum", std::vector<std::string>(p.choices, p.choices + p.choice_count)}};
    case QUELL_FLOATS:
      return {{"type", "array"}, {"items", number(p, "number")}, {"minItems", p.count}, {"maxItems", p.count}};
    case QUELL_PATH:
      return {{"type", "string"}, {"pattern", "^(quell:.+|\\$[a-z].*)?$"}};
    default:
      return {{"type", "string"}};
  }
}

J ports(const NodeType& type) {
  J properties = J::object();
  for (const auto& p : type.inputs()) {
    J port = (p.flags & QUELL_LIST) ? ref("wires") : ref("wire");
    properties[p.name] = {{"description", fmt::format("{}{}: {}", type_name(p.type),
                                                      p.flags & QUELL_OPTIONAL ? ", optional" : "", p.doc)},
                          {"allOf", J::array({or_null(std::move(port))})}};
  }
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
}

J settings(const NodeType& type) {
  J properties = J::object();
  for (std::size_t i = 0; i < type.params().size(); ++i) {
    const auto& p = type.params()[i];
    properties[p.name] = {{"description", fmt::format("{} Takes {}.", p.doc, takes(p))},
                          {"default", J::parse(default_json(type, int(i)))},
                          {"anyOf", J::array({param_values(p), ref("parameter"), {{"type", "null"}}})}};
  }
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
}

J when_type(std::string_view name, J then) {
  return {{"if", {{"required", {"type"}}, {"properties", {{"type", {{"const", name}}}}}}}, {"then", std::move(then)}};
}

// A node of a graph or of a variant: what may stand there.
J node(const std::vector<const NodeType*>& types) {
  J names = J::array(), cases = J::array();
  for (const auto* t : types) {
    names.push_back(J{{"const", t->name()}, {"description", t->table().summary}});
    cases.push_back(when_type(t->name(), {{"properties", {{"in", ports(*t)}, {"set", settings(*t)}}}}));
  }
  J properties{
      {"type", {{"description", "A node type."}, {"oneOf", std::move(names)}}},
      {"graph",
       {{"type", "string"},
        {"description", "A graph used as a node: a file below this one's folder, or quell:parts/…"}}},
      {"in",
       {{"type", "object"}, {"description", "Wires, by input."}, {"additionalProperties", or_null(ref("wires"))}}},
      {"set", {{"type", "object"}, {"description", "Values, by parameter."}}},
      {"bypass",
       {{"type", "boolean"}, {"description", "Leave the node out: its output becomes the wire that it passes."}}}};
  return {{"type", "object"},
          {"additionalProperties", false},
          {"properties", std::move(properties)},
          {"allOf", std::move(cases)}};
}

// What must stand there in a graph that is no variant.
J complete_node(const std::vector<const NodeType*>& types) {
  J cases = J::array({ref("node"), {{"oneOf", J::array({{{"required", {"type"}}}, {{"required", {"graph"}}}})}}});
  for (const auto* t : types) {
    J required = J::array();
    for (const auto& p : t->inputs())
      if (!(p.flags & (QUELL_OPTIONAL | QUELL_LIST))) required.push_back(p.name);
    if (required.empty()) continue;
    cases.push_back(
        when_type(t->name(), {{"required", {"in"}}, {"properties", {{"in", {{"required", std::move(required)}}}}}}));
  }
  return {{"allOf", std::move(cases)}};
}

J type_names() {
  J names = J::array();
  for (const auto& t : kTypes)
    for (const char* suffix : {"", "?"}) names.push_back(fmt::format("{}{}", t.name, suffix));
  return names;
}

}  // namespace

std::string graph_schema(Registry& registry) {
  const auto types = registry.all();
  J casts = J::array(), words = J::array();
  for (const auto& t : kTypes) casts.push_back(t.name), words.push_back(t.name);
  words.push_back("any");

  J definitions;
  definitions["reference"] = {{"type", "string"},
                              {"pattern", "^[a-z][a-z0-9_]*(\\.[a-z][a-z0-9_]*)*(@-[0-9]+)?$"},
                              {"description", "input, node or node.port; with @-1 the frame before."}};
  definitions["wire"] = {
      {"anyOf", J::array({ref("reference"),
                          {{"type", "object"},
                           {"additionalProperties", false},
                           {"required", {"from"}},
                           {"properties",
                            {{"from", ref("reference")},
                             {"start",
                              {{"description", "What a delayed wire reads where there is no past."},
                               {"allOf", J::array({ref("reference")})}}},
                             {"as", {{"enum", casts}, {"description", "Take it as an image of this type."}}}}}}})}};
  definitions["wires"] = {{"anyOf", J::array({ref("wire"), {{"type", "array"}, {"items", ref("wire")}}})}};
  definitions["parameter"] = {
      {"type", "string"}, {"pattern", "^\\$[a-z][a-z0-9_]*$"}, {"description", "A parameter of this graph."}};
  definitions["node"] = node(types);
  definitions["complete_node"] = complete_node(types);

  J names = J::array();
  for (const auto* t : types) names.push_back(t->name());
  J properties;
  properties["quell"] = {{"const", 1}, {"description", "Version of the format."}};
  properties["name"] = {{"type", "string"}};
  properties["about"] = {{"type", "string"}};
  properties["$schema"] = {{"type", "string"}, {"description", "Where an editor finds this schema."}};
  properties["base"] = {{"type", "string"},
                        {"description", "This is a variant: laid over that graph, in which null removes."}};
  properties["metric"] = {
      {"type", "object"},
      {"description", "Of a graph that judges images: how its number is to be read."},
      {"additionalProperties", false},
      {"required", {"better"}},
      {"properties",
       {{"better", {{"enum", {"lower", "higher"}}}},
        {"unit", {{"type", "string"}, {"description", "As in dB; empty for a bare number."}}},
        {"perfect", {{"type", {"number", "null"}}, {"description", "What an image gets that is its reference."}}}}}};
  properties["inputs"] = map_of(
      or_null(
          {{"anyOf", J::array({{{"enum", type_names()}},
                               {{"type", "string"},
                                {"pattern", fmt::format("^({})(\\[\\])?\\??$",
                                                        fmt::join(words.get<std::vector<std::string>>(), "|"))}}})}}),
      "Roles that a sequence provides, with their types; ? for optional.");
  properties["params"] =
      map_of({{"type", {"number", "string", "boolean", "array", "null"}}}, "Values that nodes take as \"$name\".");
  properties["nodes"] = map_of(or_null(ref("node")), "Nodes by name.", kDottedName);
  properties["outputs"] = map_of(or_null(ref("wire")), "What is written.");
  properties["outputs"]["minProperties"] = 1;
  properties["set"] = {{"type", "object"}, {"description", "Of a variant: values, by level0.node.parameter."}};
  properties["swap"] = {{"type", "object"},
                        {"description", "Of a variant: other types for nodes."},
                        {"additionalProperties",
                         {{"anyOf", J::array({{{"enum", names}}, {{"type", "string"}, {"pattern", "\\.json$"}}})}}}};
  properties["wire"] = {{"type", "object"},
                        {"description", "Of a variant: other wires, by node.port."},
                        {"additionalProperties", or_null(ref("wires"))}};
  properties["bypass"] = {
      {"description", "Of a variant: nodes to leave out."},
      {"anyOf", J::array({{{"type", "string"}}, {{"type", "array"}, {"items", {{"type", "string"}}}}})}};

  J schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Quell graph";
  schema["type"] = "object";
  schema["required"] = {"quell"};
  schema["additionalProperties"] = false;
  schema["properties"] = std::move(properties);
  schema["if"] = {{"required", {"base"}}};
  schema["else"] = {{"required", {"outputs"}},
                    {"properties", {{"nodes", {{"additionalProperties", ref("complete_node")}}}}},
                    {"not",
                     {{"anyOf", J::array({{{"required", {"set"}}},
                                          {{"required", {"swap"}}},
                                          {{"required", {"wire"}}},
                                          {{"required", {"bypass"}}}})}}}};
  schema["definitions"] = std::move(definitions);
  return schema.dump(2) + "\n";
}

}  // namespace quell
