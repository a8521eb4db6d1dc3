// Entries of "inputs": file, channels and the closed list of conversions, each for the types that it can apply to.
#include "core/sequence/document.h"

#include "core/json/members.h"
#include "core/report/suggest.h"
#include "core/sequence/role.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace quell {

namespace {

const std::vector<std::string> kFormats = {"image", "games202", "cameras_json"};

// A key that converts: what reads its value, and the types that it makes sense for (none: all of floating-point
// pixels).
struct ConversionKey {
  std::string name;
  std::vector<int> types;
  std::function<std::string(const Json&, int type, Conversion&)> set;  // gives what is wrong with the value, or ""
};

std::string flag(const Json& json, bool& value) {
  if (!json.is(Json::Kind::boolean)) return fmt::format("must be true or false, not {}", json.shown());
  value = json.boolean;
  return "";
}

bool is_float(const Json& json) {
  return json.is_number() && std::abs(json.number) <= double(std::numeric_limits<float>::max());
}

std::string set_scale(const Json& json, int type, Conversion& c) {
  const auto channels = std::size_t(type_info(type)->channels);
  if (json.is(Json::Kind::text) && json.text == "size" && type == QUELL_MOTION) {
    c.scale_by_size = true;
    return "";
  }
  if (is_float(json)) {
    c.scale = {float(json.number)};
    return "";
  }
  const bool fits = json.is(Json::Kind::list) && !json.items.empty() &&
                    (channels == 0 || json.items.size() == channels) && std::ranges::all_of(json.items, is_float);
  if (!fits) {
    return fmt::format("must be a number, or a list of {}{}, not {}",
                       channels == 0 ? "numbers" : fmt::format("{} numbers", channels),
                       type == QUELL_MOTION ? ", or \"size\"" : "", json.shown());
  }
  for (const Json& item : json.items) c.scale.push_back(float(item.number));
  return "";
}

std::string set_miss(const Json& json, int type, Conversion& c) {
  if (type == QUELL_POSITION && json.is(Json::Kind::text) && json.text == "camera") {
    c.miss_is_camera = true;
    return "";
  }
  if (!is_float(json)) {
    return fmt::format("must be {}, not {}", type == QUELL_POSITION ? "a number or \"camera\"" : "a number",
                       json.shown());
  }
  c.miss = float(json.number);
  return "";
}

std::string set_space(const Json& json, int, Conversion& c) {
  if (!json.is(Json::Kind::text) || (json.text != "camera" && json.text != "world"))
    return fmt::format("must be \"camera\" or \"world\", not {}", json.shown());
  c.from_camera = json.text == "camera";
  return "";
}

const std::vector<ConversionKey>& conversion_keys() {
  static const std::vector<ConversionKey> keys = {
      {"miss", {}, set_miss},
      {"encoded", {QUELL_NORMAL, QUELL_MOTION}, [](const Json& j, int, Conversion& c) { return flag(j, c.encoded); }},
      {"negate", {}, [](const Json& j, int, Conversion& c) { return flag(j, c.negate); }},
      {"scale", {}, set_scale},
      {"flip_y", {QUELL_MOTION, QUELL_SLOPE}, [](const Json& j, int, Conversion& c) { return flag(j, c.flip_y); }},
      {"reciprocal", {QUELL_DEPTH}, [](const Json& j, int, Conversion& c) { return flag(j, c.reciprocal); }},
      {"distance", {QUELL_DEPTH}, [](const Json& j, int, Conversion& c) { return flag(j, c.distance); }},
      {"space", {QUELL_NORMAL, QUELL_POSITION}, set_space},
  };
  return keys;
}

bool applies(const ConversionKey& key, int type) {
  if (key.name == "miss") return type_info(type)->storage == Storage::pixels;
  if (key.types.empty()) return type_info(type)->storage == Storage::pixels && type != QUELL_ID;
  return std::ranges::find(key.types, type) != key.types.end();
}

// Reads one role's entry.
class InputParser {
 public:
  InputParser(const std::string& role, bool profile, DocumentContext& context)
      : profile_(profile), context_(context), diagnostics_(context.diagnostics) {
    input_.role = role;
  }

  std::optional<SequenceInput> parse(const Json& json, const std::string& path) {
    const std::size_t before = diagnostics_.errors();
    input_.position = json.position;
    if (!profile_) input_.where = path;
    if (json.is(Json::Kind::list) && profile_) {
      for (std::size_t i = 0; i < json.items.size(); ++i) entry(json.items[i], fmt::format("{}[{}]", path, i));
    } else {
      entry(json, path);
    }
    if (diagnostics_.errors() != before) return std::nullopt;
    return std::move(input_);
  }

 private:
  void error(const Json& at, const std::string& path, std::string text, std::string note = "") {
    diagnostics_.error(at.position, path, std::move(text), {std::move(note)});
  }

  void entry(const Json& json, const std::string& path) {
    ChannelChoice choice;
    choice.position = json.position;
    if (json.is(Json::Kind::text) && !profile_) {
      if (!find_type(json, path)) return;
      set_file(json, path);
      set_format(json, path);
      input_.choices.push_back(std::move(choice));
      return;
    }
    if (!json.is(Json::Kind::object)) {
      error(json, path,
            fmt::format("must be {}, not {}", profile_ ? "an object or a list of them" : "a file name or an object",
                        json.shown()));
      return;
    }
    std::vector<std::string> known = {"file", "channels", "type", "format"};
    for (const auto& key : conversion_keys()) known.push_back(key.name);
    check_keys(json, path, known, diagnostics_);
    if (!find_type(json, path)) return;
    if (const Json* file = member(json, "file", Json::Kind::text, path, diagnostics_)) {
      set_file(*file, joined(path, "file"));
    } else if (!json.find("file") && !profile_) {
      error(json, path, "has no \"file\"");
    }
    set_format(json, path);
    set_channels(json, path, choice);
    for (const auto& key : conversion_keys()) {
      const Json* value = json.find(key.name);
      if (!value) continue;
      if (!applies(key, input_.type)) {
        std::vector<std::string> types;
        for (const int t : key.types) types.emplace_back(type_name(t));
        error(*value, joined(path, key.name), fmt::format("does not apply to {}", type_name(input_.type)),
              types.empty() ? "it applies to images of numbers"
                            : fmt::format("it applies to: {}", fmt::join(types, ", ")));
        continue;
      }
      if (const std::string problem = key.set(*value, input_.type, choice.conversion); !problem.empty())
        error(*value, joined(path, key.name), problem);
    }
    input_.choices.push_back(std::move(choice));
  }

  bool find_type(const Json& json, const std::string& path) {
    const int usual = type_of_role(input_.role);
    const Json* name =
        json.is(Json::Kind::object) ? member(json, "type", Json::Kind::text, path, diagnostics_) : nullptr;
    if (!name) {
      input_.type = usual;
      if (usual == 0)
        error(json, path, fmt::format("role '{}' has no type by convention; give it a \"type\"", input_.role),
              possibilities("roles with a type", input_.role, known_roles()));
      return usual != 0;
    }
    const TypeInfo* type = type_info(name->text);
    if (!type || type_of_role(type->name) != int(type->type)) {
      std::vector<std::string> types;
      for (const TypeInfo& t : kTypes)
        if (type_of_role(t.name) == int(t.type)) types.emplace_back(t.name);
      error(*name, joined(path, "type"), fmt::format("'{}' is no type that a file can hold", name->text),
            possibilities("types", name->text, types));
      return false;
    }
    if (usual != 0 && usual != int(type->type)) {
      error(*name, joined(path, "type"),
            fmt::format("role '{}' is of type {}, not {}", input_.role, type_name(usual), type->name));
      return false;
    }
    input_.type = type->type;
    return true;
  }

  void set_file(const Json& file, const std::string& path) {
    if (file.text.empty()) {
      error(file, path, "is empty");
      return;
    }
    input_.file = FramePattern(profile_ ? file.text : (context_.folder / file.text).lexically_normal().string());
  }

  void set_format(const Json& json, const std::string& path) {
    const Json* format = member(json, "format", Json::Kind::text, path, diagnostics_);
    const bool table = type_info(input_.type)->storage == Storage::table;
    if (format) {
      const auto found = std::ranges::find(kFormats, format->text);
      if (found == kFormats.end()) {
        error(*format, joined(path, "format"), fmt::format("unknown format '{}'", format->text),
              possibilities("formats", format->text, kFormats));
        return;
      }
      input_.format = FileFormat(found - kFormats.begin());
    }
    const bool misspelt = !format && json.find("format");
    if (misspelt || table == (input_.format != FileFormat::image)) return;
    if (table) {
      error(format ? *format : json, path,
            fmt::format("{} is read from matrix files; give it a \"format\"", type_name(input_.type)),
            "formats: games202, cameras_json");
    } else {
      error(*format, joined(path, "format"),
            fmt::format("'{}' holds camera and transforms, not {}", format->text, type_name(input_.type)));
    }
  }

  void set_channels(const Json& json, const std::string& path, ChannelChoice& choice) {
    const Json* channels = json.find("channels");
    const TypeInfo& type = *type_info(input_.type);
    const std::string where = joined(path, "channels");
    if (!channels) {
      if (type.type == QUELL_FEATURES) error(json, path, "features have no usual channel names; give \"channels\"");
      return;
    }
    if (type.storage == Storage::table) {
      error(*channels, where, fmt::format("does not apply to {}", type.name));
      return;
    }
    const auto expected = std::size_t(type.channels);
    if (!channels->is(Json::Kind::list)) {
      error(*channels, where, fmt::format("must be a list of channel names, not {}", channels->shown()));
      return;
    }
    for (std::size_t i = 0; i < channels->items.size(); ++i) {
      const Json& name = channels->items[i];
      if (!name.is(Json::Kind::text)) {
        error(name, fmt::format("{}[{}]", where, i), fmt::format("must be text, not {}", name.shown()));
        return;
      }
      choice.channels.push_back(name.text);
    }
    choice.position = channels->position;
    if (choice.channels.empty() || (expected != 0 && choice.channels.size() != expected)) {
      error(*channels, where,
            fmt::format("must name {} for {}, not {}",
                        expected == 0   ? "at least one channel"
                        : expected == 1 ? "one channel"
                                        : fmt::format("{} channels", expected),
                        type.name, choice.channels.size()));
    }
  }

  bool profile_;
  DocumentContext& context_;
  Diagnostics& diagnostics_;
  SequenceInput input_;
};

}  // namespace

std::optional<SequenceInput> parse_input(const std::string& role, const Json& json, const std::string& path,
                                         bool profile, DocumentContext& context) {
  return InputParser(role, profile, context).parse(json, path);
}

}  // namespace quell
