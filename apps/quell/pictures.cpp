// Opens pictures that are compared, their reference and the features of a sequence.
#include "apps/quell/pictures.h"

#include "core/run/node_source.h"
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

// The part that gives these roles of a sequence, each under the name that it goes by here.
std::optional<JoinedSource::Part> part_of(Commander& commander, const Sequence& sequence,
                                          const SequenceOptions& options, const std::string& label,
                                          const std::map<std::string, std::string>& roles, const OpenPictures& open) {
  JoinedSource::Part part{label, nullptr, roles, false, {}};
  std::vector<std::string> theirs;
  for (const auto& [here, there] : roles) theirs.push_back(there);
  part.source = commander.open(sequence, options, theirs, open.threads, open.cancel);
  if (!part.source || !commander.diagnostics().ok()) return std::nullopt;
  return part;
}

std::optional<JoinedSource::Part> plain_part(Commander& commander, const std::string& text, const std::string& label,
                                             const std::string& role, const OpenPictures& open) {
  const Sequence sequence = pictures(text, wanted(open.frames));
  auto part = part_of(commander, sequence, {}, label, {{role, "color"}}, open);
  if (part) part->still = !sequence.inputs.front().file.numbered();
  return part;
}

}  // namespace

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

std::optional<JoinedSource::Part> open_pictures(Commander& commander, const std::string& text, const std::string& label,
                                                const std::string& role, const OpenPictures& open) {
  if (!is_sequence(text)) return plain_part(commander, text, label, role, open);
  const auto options = sequence_options(text, open);
  const auto sequence = commander.load(options);
  if (!sequence) return std::nullopt;
  return part_of(commander, *sequence, options, label, {{role, "color"}}, open);
}

std::optional<JoinedSource::Part> open_reference(Commander& commander, const std::string& text,
                                                 const std::string& label, const OpenPictures& open) {
  if (!is_sequence(text)) return plain_part(commander, text, label, "reference", open);
  const auto options = sequence_options(text, open);
  auto sequence = commander.load(options);
  if (!sequence) return std::nullopt;
  if (sequence->reference_source) {
    sequence->source = std::move(sequence->reference_source);
    return part_of(commander, *sequence, options, label, {{"reference", "color"}}, open);
  }
  std::map<std::string, std::string> roles;
  for (const auto& reference : sequence->references) roles[reference.role] = reference.role;
  if (roles.empty()) return part_of(commander, *sequence, options, label, {{"reference", "color"}}, open);
  auto part = part_of(commander, *sequence, options, label, roles, open);
  if (!part) return part;
  part->sparse = static_cast<FileSequence&>(*part->source).reference_frames();
  if (part->sparse.empty())
    throw Error(Exit::input, fmt::format("{}: no frame has all its reference's files, the first of which would be {}",
                                         label, sequence->references[0].file.path(sequence->frames[0])));
  return part;
}

std::optional<JoinedSource::Part> open_features(Commander& commander, const std::string& text, const std::string& label,
                                                const std::set<std::string>& roles, const OpenPictures& open) {
  const auto options = sequence_options(text, open);
  const auto sequence = commander.load(options);
  if (!sequence) return std::nullopt;
  auto there = sequence->roles();
  if (sequence->source)
    for (const auto& port : commander.registry().find(sequence->source->type)->outputs()) there[port.name] = port.type;
  std::map<std::string, std::string> read;
  for (const auto& role : roles)
    if (there.contains(role) && !role.starts_with("reference")) read[role] = role;
  return part_of(commander, *sequence, options, label, read, open);
}

}  // namespace quell
