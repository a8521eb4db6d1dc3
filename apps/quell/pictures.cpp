// Opens pictures that are compared, their reference and the features of a sequence.
#include "apps/quell/pictures.h"

#include "core/lab/kept_source.h"
#include "core/run/node_source.h"
#include "core/run/source_node.h"
#include "core/sequence/pictures.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace quell {

namespace {

bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '+' || c == '.';
  });
}

std::optional<std::string> wanted(const std::string& frames) {
  return frames.empty() ? std::nullopt : std::optional(frames);
}

SequenceOptions sequence_options(const std::string& text, const OpenPictures& open) {
  SequenceOptions options;
  options.sequence = text;
  options.frames = open.frames;
  if (text.ends_with(".json")) options.root = open.root;
  return options;
}

void note_files(const Sequence& sequence, const OpenPictures& open) {
  open.read.insert(plain_path(sequence.path));
  for (const auto* list : {&sequence.inputs, &sequence.references})
    for (const auto& input : *list)
      for (const auto frame : sequence.frames) open.read.insert(plain_path(input.file.path(frame)));
}

// Adds the part that gives these roles of a sequence, each under the name that it goes by here; nullptr when it cannot.
JoinedSource::Part* add_part(Commander& commander, const Sequence& sequence, const SequenceOptions& options,
                             const std::string& label, const std::map<std::string, std::string>& roles,
                             const OpenPictures& open, std::vector<JoinedSource::Part>& parts) {
  std::vector<std::string> theirs;
  for (const auto& [here, there] : roles) theirs.push_back(there);
  auto source = commander.open(sequence, options, theirs, open.threads, open.cancel);
  if (!source || !commander.diagnostics().ok()) return nullptr;
  note_files(sequence, open);
  return &parts.emplace_back(JoinedSource::Part{label, std::move(source), roles, false, {}});
}

void add_plain(Commander& commander, const std::string& text, const std::string& label, const std::string& role,
               const OpenPictures& open, std::vector<JoinedSource::Part>& parts) {
  const Sequence sequence = pictures(text, wanted(open.frames));
  if (auto* part = add_part(commander, sequence, {}, label, {{role, "color"}}, open, parts))
    part->still = !sequence.inputs.front().file.numbered();
}

}  // namespace

std::string plain_path(const std::string& path) { return std::filesystem::absolute(path).lexically_normal().string(); }

Pictures parse_pictures(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || !is_name(std::string_view(text).substr(0, equals))) return {text, text};
  if (equals + 1 == text.size())
    throw Error(Exit::usage,
                fmt::format("'{}': NAME= is followed by the pictures, as in svgf=out/color.####.exr", text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

bool is_sequence(const std::string& text) {
  std::error_code error;
  if (text.ends_with(".json") || std::filesystem::is_directory(text, error)) return true;
  return text.find_first_of("/.#@%") == std::string::npos && !std::filesystem::exists(text, error);
}

void open_pictures(Commander& commander, const std::string& text, const std::string& label, const std::string& role,
                   const OpenPictures& open, std::vector<JoinedSource::Part>& parts) {
  if (!is_sequence(text)) {
    try {
      return add_plain(commander, text, label, role, open, parts);
    } catch (const Error& e) {
      const auto equals = text.find('=');
      if (equals == std::string::npos || is_name(text.substr(0, equals))) throw;
      throw Error(e.exit(), fmt::format("{}\n  nor is '{}' a NAME for pictures: names have letters, digits and _-+.",
                                        e.what(), text.substr(0, equals)));
    }
  }
  const auto options = sequence_options(text, open);
  if (const auto sequence = commander.load(options))
    add_part(commander, *sequence, options, label, {{role, "color"}}, open, parts);
}

void open_reference(Commander& commander, const std::string& text, const std::string& label, const OpenPictures& open,
                    std::vector<JoinedSource::Part>& parts) {
  if (!is_sequence(text)) return add_plain(commander, text, label, "reference", open, parts);
  const auto options = sequence_options(text, open);
  auto sequence = commander.load(options);
  if (!sequence) return;
  auto made = sequence->reference_sources;
  const bool own = !made.empty() || !sequence->references.empty();
  if (!own && sequence->source) made.push_back({"reference", *sequence->source});
  for (const auto& half : made) {
    const auto node =
        source_instance(half.node, {}, commander.registry(), commander.locations().graphs, commander.diagnostics());
    if (!node) return;
    auto source = std::make_unique<NodeSource>(*node, sequence->frames, sequence->cuts, open.threads, open.cancel);
    parts.push_back({label, keep_reference(std::move(source), *node, open.references), {{half.role, "color"}}});
  }
  if (!made.empty()) return note_files(*sequence, open);
  std::map<std::string, std::string> roles;
  for (const auto& reference : sequence->references) roles[reference.role] = reference.role;
  if (!own) roles["reference"] = "color";
  auto* part = add_part(commander, *sequence, options, label, roles, open, parts);
  if (!part || !own) return;
  part->sparse = static_cast<FileSequence&>(*part->source).reference_frames();
  if (part->sparse.empty())
    throw Error(Exit::input, fmt::format("{}: no frame has all its reference's files, the first of which would be {}",
                                         label, sequence->references[0].file.path(sequence->frames[0])));
}

void open_features(Commander& commander, const std::string& text, const std::string& label,
                   const std::set<std::string>& roles, const OpenPictures& open,
                   std::vector<JoinedSource::Part>& parts) {
  const auto options = sequence_options(text, open);
  const auto sequence = commander.load(options);
  if (!sequence) return;
  auto there = sequence->roles();
  if (sequence->source)
    for (const auto& port : commander.registry().find(sequence->source->type)->outputs()) there[port.name] = port.type;
  std::map<std::string, std::string> read;
  for (const auto& role : roles)
    if (there.contains(role) && !role.starts_with("reference")) read[role] = role;
  if (!read.empty()) add_part(commander, *sequence, options, label, read, open, parts);
}

}  // namespace quell
