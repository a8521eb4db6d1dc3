// Lays a variant over its base and reads its short forms.
#include "core/graph/variant.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

bool short_form(const std::string& key) {
  return key == "base" || key == "set" || key == "swap" || key == "wire" || key == "bypass";
}

// How deep keys are merged below a section: nodes.blur.in.image is replaced as one, and so is inputs.color.
constexpr int kSections = 1;
int merge_depth(const std::string& section) {
  if (section == "nodes") return kSections + 3;
  if (section == "inputs" || section == "params" || section == "outputs") return kSections + 1;
  return kSections;
}

void merge(Json& base, const Json& over, int depth, const std::string& path, Faults& faults) {
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < base.members.size(); ++i) index.emplace(base.members[i].key, i);
  std::vector<bool> removed(base.members.size(), false);
  for (const auto& m : over.members) {
    if (path.empty() && short_form(m.key)) continue;
    const std::string at = path.empty() ? m.key : path + "." + m.key;
    const auto it = index.find(m.key);
    const bool gone = it == index.end() || removed[it->second];
    if (m.value.is(Json::Kind::null)) {
      if (gone)
        faults.error(m.value.position, at, fmt::format("there is no '{}' in the base that null could remove", m.key));
      else
        removed[it->second] = true;
    } else if (it == index.end()) {
      base.members.push_back(m);
    } else {
      auto& below = base.members[it->second];
      removed[it->second] = false;
      const int left = path.empty() ? merge_depth(m.key) - 1 : depth - 1;
      if (left > 0 && below.value.is(Json::Kind::object) && m.value.is(Json::Kind::object))
        merge(below.value, m.value, left, at, faults);
      else
        below = m;
    }
    // A node that is given a type is no longer a graph, and the other way round.
    const auto drop = [&](const char* other) {
      if (const auto o = index.find(other); depth == 2 && o != index.end() && !over.find(other))
        removed[o->second] = true;
    };
    if (!m.value.is(Json::Kind::null) && m.key == "type") drop("graph");
    if (!m.value.is(Json::Kind::null) && m.key == "graph") drop("type");
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < base.members.size(); ++i) {
    if (i < removed.size() && removed[i]) continue;
    if (kept != i) base.members[kept] = std::move(base.members[i]);
    ++kept;
  }
  base.members.resize(kept);
}

class ShortForms {
 public:
  explicit ShortForms(Faults& faults) : faults_(faults) {}
  std::vector<Change> changes;

  void set(const std::string& target, TextPosition position, const Json& value, const std::string& path) {
    if (auto* c =
            add(Change::Kind::set, target, position, path, 1, "parameter, node.parameter or level0.node.parameter"))
      c->value = value;
  }
  void swap(const std::string& target, TextPosition position, const Json& value, const std::string& path) {
    if (!value.is(Json::Kind::text) || value.text.empty())
      return faults_.error(value.position, path, fmt::format("a node type must be text, not {}", value.shown()));
    if (auto* c = add(Change::Kind::swap, target, position, path, 1, "node or level0.node"))
      c->type = value.text, c->value_position = value.position;
  }
  void wire(const std::string& target, TextPosition position, const Json& value, const std::string& path) {
    std::optional<Binding> binding = Binding{"", position, true, {}};
    if (!value.is(Json::Kind::null)) binding = parse_binding("", position, value, path, faults_);
    if (!binding) return;
    if (auto* c = add(Change::Kind::wire, target, position, path, 2, "node.port or level0.node.port")) {
      c->binding = std::move(*binding);
      c->binding.port = c->target.back();
    }
  }
  void bypass(const std::string& target, TextPosition position, const std::string& path) {
    if (auto* c = add(Change::Kind::bypass, target, position, path, 1, "node or level0.node"))
      c->value_position = position;
  }

 private:
  Change* add(Change::Kind kind, const std::string& target, TextPosition position, const std::string& path,
              std::size_t parts, std::string_view form) {
    Change c;
    c.kind = kind;
    c.target = split_path(target);
    c.position = position;
    if (c.target.size() < parts) {
      faults_.error(position, path, fmt::format("'{}' is not of the form {}", target, form));
      return nullptr;
    }
    return &changes.emplace_back(std::move(c));
  }

  Faults& faults_;
};

}  // namespace

Json overlay(Json base, const Json& variant, Faults& faults) {
  base.position = variant.position;
  merge(base, variant, 0, "", faults);
  return base;
}

namespace {

bool overridden(const Change& change, const Json& over) {
  const auto below = [](const Json* json, const std::string& key) { return json ? json->find(key) : nullptr; };
  const auto& target = change.target;
  if (change.kind == Change::Kind::set && target.size() == 1) return below(over.find("params"), target[0]);
  const Json* node = nullptr;
  std::string name;  // it may have dots
  std::size_t parts = 0;
  for (; parts < target.size() && !node; ++parts) {
    name += (parts ? "." : "") + target[parts];
    node = below(over.find("nodes"), name);
  }
  if (!node || node->is(Json::Kind::null)) return node;
  const std::size_t behind = target.size() - parts;
  switch (change.kind) {
    case Change::Kind::set:
      return behind == 1 && below(below(node, "set"), target.back());
    case Change::Kind::wire:
      return behind == 1 && below(below(node, "in"), target.back());
    case Change::Kind::swap:
      return behind == 0 && (below(node, "type") || below(node, "graph"));
    case Change::Kind::bypass:
      return behind == 0 && below(node, "bypass");
  }
  return false;
}

}  // namespace

void drop_overridden(std::vector<Change>& changes, const Json& over) {
  std::erase_if(changes, [&](const Change& change) { return overridden(change, over); });
}

std::vector<Change> parse_changes(const Json& variant, Faults& faults) {
  ShortForms forms(faults);
  const auto each = [&](const char* key, auto use) {
    const auto* j = variant.find(key);
    if (!j) return;
    if (!j->is(Json::Kind::object)) {
      faults.error(j->position, key, fmt::format("\"{}\" must be an object, not {}", key, j->shown()));
      return;
    }
    for (const auto& m : j->members) use(m.key, m.key_position, m.value, fmt::format("{}.{}", key, m.key));
  };
  each("swap", [&](auto&&... a) { forms.swap(a...); });
  each("wire", [&](auto&&... a) { forms.wire(a...); });
  if (const auto* j = variant.find("bypass")) {
    const bool list = j->is(Json::Kind::list);
    for (const auto& name : list ? std::span(j->items) : std::span(j, 1)) {
      if (name.is(Json::Kind::text))
        forms.bypass(name.text, name.position, "bypass");
      else
        faults.error(name.position, "bypass", fmt::format("\"bypass\" must name nodes, not {}", name.shown()),
                     {"as in \"bypass\": [\"clamp\"]"});
    }
  }
  each("set", [&](auto&&... a) { forms.set(a...); });
  return std::move(forms.changes);
}

namespace {

void place(Json& json, TextPosition position) {
  json.position = position;
  for (auto& item : json.items) place(item, position);
  for (auto& m : json.members) m.key_position = position, place(m.value, position);
}

// A value as typed into a shell: JSON when it is that, else text.
Json value_of(const std::string& text, TextPosition position) {
  Diagnostics quiet;
  auto json = parse_json("", text, quiet);
  if (!json) return text_json(text, position);
  place(*json, position);
  return std::move(*json);
}

// As a wire: "a,b" is a list, and words that happen to be JSON numbers stay text.
Json wire_of(const std::string& text, TextPosition position) {
  Json value = value_of(text, position);
  if (!value.is(Json::Kind::text) || text.starts_with('"') || text.find(',') == text.npos) return value;
  std::vector<Json> items;
  for (std::size_t at = 0, comma = 0; comma != text.npos; at = comma + 1) {
    comma = text.find(',', at);
    items.push_back(text_json(text.substr(at, comma - at), position));
  }
  return list_json(std::move(items), position);
}

}  // namespace

Edits parse_edits(std::span<const Edit> edits, Faults& faults) {
  static constexpr const char* kNames[] = {"--set", "--swap", "--wire", "--bypass", "--tap"};
  int counts[std::size(kNames)] = {};
  ShortForms forms(faults);
  Edits out;
  for (const auto& e : edits) {
    const auto k = std::size_t(e.kind);
    const TextPosition position{faults.sources().add(fmt::format("{} #{}", kNames[k], ++counts[k]), e.text), 0};
    if (e.kind == Edit::Kind::bypass) {
      forms.bypass(e.text, position, "");
      continue;
    }
    if (e.kind == Edit::Kind::tap) {
      Tap tap{e.text, {}};
      tap.wire.position = position;
      const auto problem = parse_reference(e.text, tap.wire.from);
      if (problem.text.empty())
        out.taps.push_back(std::move(tap));
      else
        faults.error(position, "", problem.text, {problem.note});
      continue;
    }
    const std::size_t equals = e.text.find('=');
    if (equals == std::string::npos) {
      static constexpr const char* kForms[] = {"level0.atrous.step=2", "by_normal=plane_weight",
                                               "history.image=level1.image@-1"};
      faults.error(position, "", fmt::format("'{}' has no '='", e.text),
                   {fmt::format("as in {} {}", kNames[k], kForms[k])});
      continue;
    }
    const std::string target = e.text.substr(0, equals), text = e.text.substr(equals + 1);
    const TextPosition at{position.source, equals + 1};
    if (e.kind == Edit::Kind::set) forms.set(target, position, value_of(text, at), "");
    if (e.kind == Edit::Kind::wire) forms.wire(target, position, wire_of(text, at), "");
    if (e.kind == Edit::Kind::swap) forms.swap(target, position, text_json(text, at), "");
  }
  std::ranges::stable_sort(forms.changes, {}, &Change::kind);
  out.changes = std::move(forms.changes);
  return out;
}

}  // namespace quell
