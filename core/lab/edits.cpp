// Edits of a graph as text.
#include "core/lab/edits.h"

#include "core/report/shell.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace quell {

using nlohmann::ordered_json;

namespace {

ordered_json to_json(const Json& j) {
  switch (j.kind) {
    case Json::Kind::null:
      return nullptr;
    case Json::Kind::boolean:
      return j.boolean;
    case Json::Kind::integer:
      return j.integer;
    case Json::Kind::number:
      return j.number;
    case Json::Kind::text:
      return j.text;
    case Json::Kind::list: {
      auto list = ordered_json::array();
      for (const auto& item : j.items) list.push_back(to_json(item));
      return list;
    }
    case Json::Kind::object:
      break;
  }
  auto object = ordered_json::object();
  for (const auto& m : j.members) object[m.key] = to_json(m.value);
  return object;
}

// As the command line takes it: text as it is where that reads as no JSON, all else as JSON.
std::string value(const Json& j) {
  if (j.is(Json::Kind::text) && !ordered_json::accept(j.text)) return j.text;
  return to_json(j).dump();
}

}  // namespace

Json edits_of(const Json& object) {
  Json edits = object_json(object.position);
  for (const auto& m : object.members)
    if (m.key == "set" || m.key == "swap" || m.key == "wire" || m.key == "bypass") edits.members.push_back(m);
  return edits;
}

std::string edits_text(const Json& edits) { return to_json(edits).dump(); }

std::string run_command(const Study& study, const StudyVariant& variant) {
  const auto& sequence = study.sequences.front();
  const bool built_in = sequence.written.find_first_of("/.#@%") == std::string::npos;
  std::vector<std::string> words = {"quell", "run", variant.graph, built_in ? sequence.written : sequence.path};
  const auto option = [&](const char* name, const std::string& argument) {
    words.emplace_back(name), words.push_back(argument);
  };
  if (sequence.root) option("--root", *sequence.root);
  if (sequence.frames) option("--frames", *sequence.frames);
  for (const auto& m : sequence.source) option("--source", fmt::format("{}={}", m.key, value(m.value)));
  if (study.seeds) option("--source", fmt::format("{}={}", study.seeds->parameter, study.seeds->values[0]));
  for (const char* form : {"swap", "wire", "set"})
    if (const Json* edits = variant.edits.find(form))
      for (const auto& m : edits->members)
        option(fmt::format("--{}", form).c_str(), fmt::format("{}={}", m.key, value(m.value)));
  if (const Json* bypass = variant.edits.find("bypass"))
    for (const auto& name : bypass->is(Json::Kind::list) ? std::span(bypass->items) : std::span(bypass, 1))
      option("--bypass", name.text);
  return shell_text(words);
}

}  // namespace quell
