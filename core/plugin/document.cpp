// The same facts of a node type's table in three forms.
#include "core/plugin/document.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace quell {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string range_text(const quell_param& p) {
  const bool low = std::isfinite(p.min), high = std::isfinite(p.max);
  if (low && high) return fmt::format(" from {} to {}", float(p.min), float(p.max));
  if (low) return fmt::format(" of at least {}", float(p.min));
  if (high) return fmt::format(" of at most {}", float(p.max));
  return "";
}

const char* kind_name(int kind) {
  switch (kind) {
    case QUELL_BOOL:
      return "bool";
    case QUELL_INT:
      return "int";
    case QUELL_FLOAT:
      return "float";
    case QUELL_CHOICE:
      return "choice";
    case QUELL_FLOATS:
      return "floats";
    case QUELL_TEXT:
      return "text";
    default:
      return "path";
  }
}

// Whole numbers without a point, but for minus nothing, which would become nothing.
OrderedJson number(float v) {
  const bool minus_nothing = v == 0 && std::signbit(v);
  return minus_nothing ? OrderedJson(-0.0) : OrderedJson::parse(fmt::format("{}", v));
}

OrderedJson value_of(const Instance& instance, int param) {
  const auto& p = instance.type().params()[std::size_t(param)];
  switch (p.kind) {
    case QUELL_BOOL:
      return instance.get_bool(param);
    case QUELL_INT:
      return instance.get_int(param);
    case QUELL_FLOAT:
      return number(instance.get_float(param));
    case QUELL_CHOICE:
      return p.choices[instance.get_int(param)];
    case QUELL_FLOATS: {
      OrderedJson list = OrderedJson::array();
      for (const float v : instance.get_floats(param)) list.push_back(number(v));
      return list;
    }
    default:
      return std::string(instance.get_text(param));
  }
}

OrderedJson default_of(const NodeType& type, int param) { return value_of(Instance(type), param); }

// "radiance", "weight[]", "id?".
std::string type_text(const quell_port& port) {
  std::string text(type_name(port.type));
  if (port.flags & QUELL_LIST) text += "[]";
  if (port.flags & QUELL_OPTIONAL) text += "?";
  return text;
}

std::string output_note(const NodeType& type, const quell_port& port) {
  std::string note;
  if (port.passes >= 0)
    note += fmt::format(" A bypass gives its input {}.", type.inputs()[std::size_t(port.passes)].name);
  if (port.with >= 0)
    note += fmt::format(" Exists only with its input {}.", type.inputs()[std::size_t(port.with)].name);
  return note;
}

}  // namespace

std::string markdown_cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string takes(const quell_param& p) {
  switch (p.kind) {
    case QUELL_BOOL:
      return "true or false";
    case QUELL_INT:
      return "a whole number" + range_text(p);
    case QUELL_FLOAT:
      return "a number" + range_text(p);
    case QUELL_CHOICE:
      return fmt::format("one of {}", fmt::join(p.choices, p.choices + p.choice_count, ", "));
    case QUELL_FLOATS:
      return fmt::format("a list of {} numbers{}", p.count, range_text(p));
    case QUELL_TEXT:
      return "text";
    default:
      return "a file";
  }
}

std::string default_json(const NodeType& type, int param) { return default_of(type, param).dump(); }

std::string value_json(const Instance& instance, int param) {
  // A text from a command line need not be UTF-8.
  return value_of(instance, param).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

std::string document_text(const NodeType& type) {
  std::string out = fmt::format("{}  {}\n", type.name(), type.table().summary);
  if (*type.table().source) out += fmt::format("  Source: {}\n", type.table().source);
  std::size_t width = 0;
  const auto widen = [&](std::string_view name) { width = std::max(width, name.size()); };
  for (const auto& p : type.inputs()) widen(p.name);
  for (const auto& p : type.outputs()) widen(p.name);
  for (const auto& p : type.params()) widen(p.name);
  if (!type.inputs().empty()) out += "\nInputs\n";
  for (const auto& p : type.inputs()) out += fmt::format("  {:<{}}  {:<10}  {}\n", p.name, width, type_text(p), p.doc);
  out += "\nOutputs\n";
  for (const auto& p : type.outputs())
    out += fmt::format("  {:<{}}  {:<10}  {}{}\n", p.name, width, type_text(p), p.doc, output_note(type, p));
  if (!type.params().empty()) out += "\nParameters\n";
  for (std::size_t i = 0; i < type.params().size(); ++i) {
    const auto& p = type.params()[i];
    out += fmt::format("  {:<{}}  {}\n  {:<{}}  {}; default {}\n", p.name, width, p.doc, "", width, takes(p),
                       default_json(type, int(i)));
  }
  return out;
}

std::string document_markdown(const NodeType& type) {
  std::string out = fmt::format("## {}\n\n{}\n", type.name(), type.table().summary);
  if (type.is_weight()) out += "\nA weight node: wire it into the `weights` of a filter.\n";
  if (*type.table().source) out += fmt::format("\nSource: {}\n", type.table().source);
  if (!type.inputs().empty()) out += "\n| input | type | |\n|---|---|---|\n";
  for (const auto& p : type.inputs())
    out += fmt::format("| `{}` | {} | {} |\n", p.name, type_text(p), markdown_cell(p.doc));
  out += "\n| output | type | |\n|---|---|---|\n";
  for (const auto& p : type.outputs())
    out += fmt::format("| `{}` | {} | {}{} |\n", p.name, type_text(p), markdown_cell(p.doc), output_note(type, p));
  if (!type.params().empty()) out += "\n| parameter | takes | default | |\n|---|---|---|---|\n";
  for (std::size_t i = 0; i < type.params().size(); ++i) {
    const auto& p = type.params()[i];
    out += fmt::format("| `{}` | {} | `{}` | {} |\n", p.name, markdown_cell(takes(p)),
                       markdown_cell(default_json(type, int(i))), markdown_cell(p.doc));
  }
  return out;
}

std::string document_json(const NodeType& type) {
  OrderedJson json;
  json["name"] = type.name();
  json["summary"] = type.table().summary;
  json["source"] = type.table().source;
  json["version"] = type.version();
  json["weight"] = type.is_weight();
  json["inputs"] = OrderedJson::array();
  for (const auto& p : type.inputs())
    json["inputs"].push_back({{"name", p.name},
                              {"type", type_name(p.type)},
                              {"optional", (p.flags & QUELL_OPTIONAL) != 0},
                              {"list", (p.flags & QUELL_LIST) != 0},
                              {"doc", p.doc}});
  json["outputs"] = OrderedJson::array();
  for (const auto& p : type.outputs()) {
    OrderedJson out{{"name", p.name}, {"type", type_name(p.type)}, {"doc", p.doc}};
    if (p.passes >= 0) out["passes"] = type.inputs()[std::size_t(p.passes)].name;
    if (p.with >= 0) out["with"] = type.inputs()[std::size_t(p.with)].name;
    json["outputs"].push_back(std::move(out));
  }
  json["params"] = OrderedJson::array();
  for (std::size_t i = 0; i < type.params().size(); ++i) {
    const auto& p = type.params()[i];
    OrderedJson param{
        {"name", p.name}, {"kind", kind_name(p.kind)}, {"default", default_of(type, int(i))}, {"doc", p.doc}};
    const bool number = p.kind == QUELL_INT || p.kind == QUELL_FLOAT || p.kind == QUELL_FLOATS;
    if (number && std::isfinite(p.min)) param["min"] = p.min;
    if (number && std::isfinite(p.max)) param["max"] = p.max;
    if (p.kind == QUELL_FLOATS) param["count"] = p.count;
    if (p.kind == QUELL_CHOICE) param["choices"] = std::vector<std::string>(p.choices, p.choices + p.choice_count);
    json["params"].push_back(std::move(param));
  }
  return json.dump(2);
}

}  // namespace quell
