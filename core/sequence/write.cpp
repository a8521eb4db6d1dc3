// Keys as core/sequence/sequence.cpp and document.cpp read them.
#include "core/sequence/write.h"

#include "core/graph/library.h"
#include "core/json/number.h"
#include "core/plugin/document.h"
#include "core/sequence/frame_range.h"
#include "core/sequence/role.h"

#include <quell/types.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace quell {

namespace {

namespace fs = std::filesystem;
using J = nlohmann::ordered_json;

fs::path whole_path(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path.empty() ? "." : path, error).lexically_normal();
}

J begin(std::span<const std::int64_t> frames, const std::set<std::int64_t>& cuts) {
  J json{{"quell_sequence", 1}, {"frames", frame_range_text(frames)}};
  for (const auto frame : frames)
    if (cuts.contains(frame)) json["cuts"].push_back(frame);
  return json;
}

void add(const Conversion& c, J& json) {
  if (c.miss) json["miss"] = shortest_number(*c.miss);
  if (c.miss_is_camera) json["miss"] = "camera";
  if (c.encoded) json["encoded"] = true;
  if (c.negate) json["negate"] = true;
  for (const float v : c.scale) json["scale"].push_back(shortest_number(v));
  // One factor for all channels is no list.
  if (c.scale.size() == 1) json["scale"] = shortest_number(c.scale[0]);
  if (c.scale_by_size) json["scale"] = "size";
  if (c.flip_y) json["flip_y"] = true;
  if (c.reciprocal) json["reciprocal"] = true;
  if (c.distance) json["distance"] = true;
  if (c.from_camera) json["space"] = "camera";
}

J entry(const SequenceInput& input, const fs::path& root) {
  J json{{"file", name_below(root, input.file.text())}};
  if (type_of_role(input.role) == 0 && !input.role.starts_with("reference")) json["type"] = type_name(input.type);
  static constexpr const char* kFormats[] = {"image", "games202", "cameras_json"};
  if (input.format != FileFormat::image) json["format"] = kFormats[int(input.format)];
  const auto& choice = input.choices.front();
  if (!choice.channels.empty()) json["channels"] = choice.channels;
  add(choice.conversion, json);
  return json;
}

// A file's name need not be UTF-8.
std::string text_of(const J& json) { return json.dump(-1, ' ', false, J::error_handler_t::replace); }

}  // namespace

std::string write_sequence(const Sequence& sequence) {
  J json = begin(sequence.frames, sequence.cuts);
  json["root"] = whole_path(sequence.root).generic_string();
  auto& inputs = json["inputs"] = J::object();
  for (const auto& input : sequence.inputs) inputs[input.role] = entry(input, sequence.root);
  for (const auto& input : sequence.references) {
    auto& reference = json["reference"];
    (input.role == "reference" ? reference : reference[input.role == "reference_a" ? "A" : "B"]) =
        entry(input, sequence.root);
  }
  return text_of(json);
}

std::string write_sequence(const Instance& source, std::span<const std::int64_t> frames,
                           const std::set<std::int64_t>& cuts, const fs::path& graphs) {
  J json = begin(frames, cuts);
  auto& node = json["source"] = {{"type", source.type().name()}};
  for (std::size_t p = 0; p < source.type().params().size(); ++p) {
    J value = J::parse(value_json(source, int(p)));
    if (source.type().params()[p].kind == QUELL_PATH)
      if (auto name = installed_name(graphs, source.get_text(int(p)))) value = *name;
    node["set"][source.type().params()[p].name] = std::move(value);
  }
  return text_of(json);
}

std::string name_below(const fs::path& root, const std::string& path) {
  const auto whole = whole_path(path), below = whole.lexically_relative(whole_path(root));
  return (below.empty() || *below.begin() == ".." ? whole : below).generic_string();
}

}  // namespace quell
