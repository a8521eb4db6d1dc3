// What a study leaves to be written out: one variant a value of a sweep, a node left out, a level fed back.
#include "core/lab/variants.h"

#include "core/json/members.h"
#include "core/lab/edits.h"
#include "core/lab/range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace quell {

namespace {

constexpr std::string_view kInNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.=,+-";
constexpr std::size_t kLongestName = 120;

// { "set": { … } } and the like.
Json edit(const char* form, Json value) {
  Json edits = object_json(value.position);
  edits.members.push_back({form, value.position, std::move(value)});
  return edits;
}

std::string value_text(const Json& value) {
  if (value.is(Json::Kind::text)) return value.text;
  if (value.is(Json::Kind::integer)) return fmt::format("{}", value.integer);
  if (value.is(Json::Kind::number)) return fmt::format("{}", value.number);
  if (!value.is(Json::Kind::list)) return value.shown();
  std::string text;
  for (const auto& item : value.items) text += (text.empty() ? "" : ",") + value_text(item);
  return text;
}

// A value as part of a variant's name.
std::string as_name(std::string text) {
  for (char& c : text)
    if (kInNames.find(c) == kInNames.npos) c = '_';
  return text;
}

// A number of a range: to six digits, so that its name says exactly what is set.
Json number_at(TextPosition position, double value) {
  Json json;
  json.position = position;
  json.number = six_digits(value);
  json.kind =
      json.number == std::floor(json.number) && std::abs(json.number) < 1e15 ? Json::Kind::integer : Json::Kind::number;
  if (json.is(Json::Kind::integer)) json.integer = std::int64_t(json.number);
  return json;
}

struct Sweep {
  std::string target;
  TextPosition position;
  std::vector<Json> values;
};

class Expander {
 public:
  Expander(std::string graph, std::filesystem::path folder, Diagnostics& diagnostics)
      : graph_(std::move(graph)), folder_(std::move(folder)), diagnostics_(diagnostics) {}

  std::vector<StudyVariant> expand(const Json& study) {
    add("base", "The graph as it is.", object_json(study.find("graph")->position), "graph");
    written(study);
    left_out(study);
    fed_back(study);
    const auto crossed = sweeps(study, "sweeps");
    if (!crossed.empty()) cross(crossed);
    for (const auto& sweep : sweeps(study, "sweep_separately"))
      for (const auto& value : sweep.values) add_point({{&sweep, &value}}, "sweep_separately." + sweep.target);
    baselines(study);
    return std::move(variants_);
  }

 private:
  void error(TextPosition position, std::string path, std::string text, std::vector<std::string> notes = {}) {
    diagnostics_.error(position, std::move(path), std::move(text), std::move(notes));
  }

  StudyVariant* add(std::string name, std::string about, Json edits, std::string where) {
    if (tried_++ >= kMaxVariants) {
      if (tried_ == kMaxVariants + 1)
        error(edits.position, where, fmt::format("there are more than {} variants", kMaxVariants));
      return nullptr;
    }
    if (const auto why = problem_of_name(name); !why.empty()) error(edits.position, where, why);
    const auto same = std::ranges::find(variants_, name, &StudyVariant::name);
    if (same != variants_.end())
      error(edits.position, where, fmt::format("two variants are called '{}'", name),
            {fmt::format("the other is {} ({})", same->where, diagnostics_.sources.place(same->position))});
    const auto position = edits.position;
    variants_.push_back({std::move(name), std::move(about), graph_file(graph_, folder_), std::move(edits), false,
                         position, std::move(where)});
    return &variants_.back();
  }

  void written(const Json& study) {
    const Json* all = member(study, "variants", Json::Kind::object, "", diagnostics_);
    if (!all) return;
    for (const auto& m : all->members) {
      const std::string where = "variants." + m.key;
      if (!m.value.is(Json::Kind::object)) {
        error(m.value.position, where, fmt::format("a variant is an object, not {}", m.value.shown()));
        continue;
      }
      check_keys(m.value, where, std::vector<std::string>{"about", "graph", "set", "swap", "wire", "bypass"},
                 diagnostics_);
      const auto about = text_member(m.value, "about", where, diagnostics_);
      const auto graph = text_member(m.value, "graph", where, diagnostics_);
      Json edits = edits_of(m.value);
      edits.position = m.key_position;
      auto* variant = add(m.key, about.value_or(""), std::move(edits), where);
      if (variant && graph) variant->graph = graph_file(*graph, folder_);
    }
  }

  // Names of nodes: one, or several that go together.
  std::optional<std::vector<std::string>> nodes(const Json& item, const std::string& where) {
    std::vector<std::string> names;
    const bool several = item.is(Json::Kind::list) && !item.items.empty();
    for (const auto& name : several ? std::span(item.items) : std::span(&item, 1)) {
      if (!name.is(Json::Kind::text) || name.text.empty()) {
        error(name.position, where, fmt::format("must name a node, or list several, not {}", name.shown()));
        return std::nullopt;
      }
      names.push_back(name.text);
    }
    return names;
  }

  void left_out(const Json& study) {
    const Json* all = member(study, "leave_one_out", Json::Kind::list, "", diagnostics_);
    if (!all) return;
    if (all->items.empty()) error(all->position, "leave_one_out", "is empty; it lists the nodes to leave out");
    for (std::size_t i = 0; i < all->items.size(); ++i) {
      const Json& item = all->items[i];
      const std::string where = fmt::format("leave_one_out[{}]", i);
      const auto names = nodes(item, where);
      if (!names) continue;
      std::vector<Json> list;
      for (const auto& name : *names) list.push_back(text_json(name, item.position));
      add(as_name(fmt::format("no_{}", fmt::join(*names, "+"))), fmt::format("Without {}.", fmt::join(*names, ", ")),
          edit("bypass", list_json(std::move(list), item.position)), where);
    }
  }

  void fed_back(const Json& study) {
    const std::string key = "each_feedback_level";
    const Json* j = member(study, key, Json::Kind::object, "", diagnostics_);
    if (!j) return;
    check_keys(*j, key, std::vector<std::string>{"wire", "levels"}, diagnostics_);
    const Json* wire = member(*j, "wire", Json::Kind::text, key, diagnostics_);
    const Json* levels = member(*j, "levels", Json::Kind::list, key, diagnostics_);
    if (!j->find("wire") || !j->find("levels"))
      error(j->position, key, "needs \"wire\", the port that reads history, and \"levels\", what it is to read",
            {R"(as in { "wire": "history.image", "levels": ["blend", "level0.image"] })"});
    if (levels && levels->items.empty())
      error(levels->position, key + ".levels", "is empty; it lists what is fed back");
    if (!wire || !levels) return;
    for (std::size_t i = 0; i < levels->items.size(); ++i) {
      const Json& level = levels->items[i];
      const std::string where = fmt::format("{}.levels[{}]", key, i);
      if (!level.is(Json::Kind::text) || level.text.empty()) {
        error(level.position, where, fmt::format("must name an output of a node, not {}", level.shown()));
        continue;
      }
      const bool delayed = level.text.find('@') != std::string::npos;
      Json wires = object_json(level.position);
      wires.members.push_back(
          {wire->text, level.position, text_json(delayed ? level.text : level.text + "@-1", level.position)});
      add(as_name("feedback=" + level.text), fmt::format("{} reads {} of the frame before.", wire->text, level.text),
          edit("wire", std::move(wires)), where);
    }
  }

  std::vector<Sweep> sweeps(const Json& study, const char* key) {
    std::vector<Sweep> all;
    const Json* j = member(study, key, Json::Kind::object, "", diagnostics_);
    if (!j) return all;
    for (const auto& m : j->members) {
      const std::string where = fmt::format("{}.{}", key, m.key);
      Sweep sweep{m.key, m.key_position, {}};
      if (m.value.is(Json::Kind::list))
        sweep.values = m.value.items;
      else if (m.value.is(Json::Kind::object))
        sweep.values = range(m.value, where);
      else
        error(m.value.position, where, fmt::format("must be a list of values or a range, not {}", m.value.shown()),
              {R"(as in [0.1, 0.2] or { "from": 1, "to": 8, "steps": 4, "scale": "log" })"});
      if (m.value.is(Json::Kind::list) && sweep.values.empty())
        error(m.value.position, where, "an empty sweep tries nothing; list at least one value");
      all.push_back(std::move(sweep));
    }
    if (j->members.empty()) error(j->position, key, "an empty sweep tries nothing; name a parameter");
    if (std::ranges::any_of(all, [](const Sweep& s) { return s.values.empty(); })) all.clear();
    return all;
  }

  std::vector<Json> range(const Json& json, const std::string& where) {
    check_keys(json, where, std::vector<std::string>{"from", "to", "steps", "scale"}, diagnostics_);
    const Json* from = member(json, "from", Json::Kind::number, where, diagnostics_);
    const Json* to = member(json, "to", Json::Kind::number, where, diagnostics_);
    const Json* steps = member(json, "steps", Json::Kind::integer, where, diagnostics_);
    const Json* scale = member(json, "scale", Json::Kind::text, where, diagnostics_);
    for (const char* key : {"from", "to", "steps"})
      if (!json.find(key)) error(json.position, where, fmt::format("a range needs \"{}\"", key));
    if (steps && (steps->integer < 2 || steps->integer > std::int64_t(kMaxVariants))) {
      error(steps->position, where + ".steps",
            fmt::format("must be from 2 to {}, not {}", kMaxVariants, steps->integer));
      steps = nullptr;
    }
    if (scale && scale->text != "linear" && scale->text != "log") {
      error(scale->position, where + ".scale", fmt::format("must be \"linear\" or \"log\", not {}", scale->shown()));
      return {};
    }
    const bool log = scale && scale->text == "log";
    if (!from || !to || !steps) return {};
    if (const auto why = problem_of_range(from->number, to->number, log); !why.empty()) {
      error(json.position, where, why);
      return {};
    }
    std::vector<Json> values;
    for (std::int64_t i = 0; i < steps->integer; ++i) {
      const double t = double(i) / double(steps->integer - 1);
      values.push_back(number_at(json.position, in_range(from->number, to->number, log, t)));
    }
    return values;
  }

  using Point = std::vector<std::pair<const Sweep*, const Json*>>;

  // Whether there was room for it.
  bool add_point(const Point& point, const std::string& where) {
    std::string name, about;
    Json set = object_json(point.front().second->position);
    for (const auto& [sweep, value] : point) {
      name += fmt::format("{}{}={}", name.empty() ? "" : ",", sweep->target, value_text(*value));
      about += fmt::format("{}{} = {}", about.empty() ? "" : ", ", sweep->target, value->shown());
      set.members.push_back({sweep->target, value->position, *value});
    }
    return add(as_name(name), about + ".", edit("set", std::move(set)), where);
  }

  // The last sweep's values change fastest.
  void cross(const std::vector<Sweep>& sweeps) {
    std::vector<std::size_t> at(sweeps.size(), 0);
    while (true) {
      Point point;
      for (std::size_t s = 0; s < sweeps.size(); ++s) point.emplace_back(&sweeps[s], &sweeps[s].values[at[s]]);
      if (!add_point(point, sweeps.size() == 1 ? "sweeps." + sweeps[0].target : "sweeps")) return;
      std::size_t s = sweeps.size();
      while (s > 0 && ++at[s - 1] == sweeps[s - 1].values.size()) at[--s] = 0;
      if (s == 0) return;
    }
  }

  void baselines(const Json& study) {
    const Json* all = member(study, "baselines", Json::Kind::list, "", diagnostics_);
    if (!all) return;
    if (all->items.empty()) error(all->position, "baselines", "is empty; it lists other graphs to compare with");
    for (std::size_t i = 0; i < all->items.size(); ++i) {
      const Json& item = all->items[i];
      const std::string where = fmt::format("baselines[{}]", i);
      if (!item.is(Json::Kind::text) || item.text.empty()) {
        error(item.position, where, fmt::format("must name a graph, not {}", item.shown()));
        continue;
      }
      const auto name = std::filesystem::path(item.text).stem().string();
      auto* variant = add(as_name(name), fmt::format("The graph {}.", item.text), object_json(item.position), where);
      if (variant) variant->graph = graph_file(item.text, folder_), variant->baseline = true;
    }
  }

  std::string graph_;
  std::filesystem::path folder_;
  Diagnostics& diagnostics_;
  std::vector<StudyVariant> variants_;
  std::size_t tried_ = 0;  // good ones or not, so that errors end too
};

}  // namespace

std::vector<StudyVariant> expand_variants(const Json& study, const std::string& graph,
                                          const std::filesystem::path& folder, Diagnostics& diagnostics) {
  return Expander(graph, folder, diagnostics).expand(study);
}

std::string graph_file(const std::string& graph, const std::filesystem::path& folder) {
  const bool installed = (graph.find('/') == graph.npos && !graph.ends_with(".json")) || graph.starts_with("quell:");
  return installed ? graph : (folder / graph).lexically_normal().string();
}

std::string problem_of_name(const std::string& name) {
  if (name.empty()) return "has no name";
  if (name.front() == '.' || name.front() == '-')
    return fmt::format("'{}' cannot be a name: it begins with '{}'", name, name.front());
  if (name.find_first_not_of(kInNames) != std::string::npos)
    return fmt::format("'{}' cannot be a name: files are called by it, so it has letters, digits and _.=,+- only",
                       name);
  if (name.size() > kLongestName)
    return fmt::format("'{}…' cannot be a name: it is longer than {} characters", name.substr(0, 20), kLongestName);
  return "";
}

}  // namespace quell
