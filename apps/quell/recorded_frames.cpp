// A sequence as core/sequence/write.h writes it, or several as core/lab/joined_source.h does.
#include "apps/quell/recorded_frames.h"

#include "core/lab/halves.h"
#include "core/lab/joined_source.h"
#include "core/sequence/frame_range.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace quell {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::map<std::string, int> roles_of(Commander& commander, const Sequence& sequence) {
  auto roles = sequence.roles();
  for (const auto& file : sequence.references) roles[file.role] = file.type;
  if (sequence.source)
    for (const auto& port : commander.registry().find(sequence.source->type)->outputs()) roles[port.name] = port.type;
  return roles;
}

}  // namespace

bool RecordedFrames::load_part(Commander& commander, SequenceRequest request, Part part) {
  auto sequence = commander.load(std::move(request));
  if (!sequence) return false;
  part.sequence = std::move(*sequence);
  if (!joined_)
    for (const auto& [role, type] : roles_of(commander, part.sequence)) part.roles[role] = role;
  for (const auto& [here, there] : part.roles) roles_[here] = roles_of(commander, part.sequence).at(there);
  parts_.push_back(std::move(part));
  return true;
}

std::optional<RecordedFrames> RecordedFrames::load(Commander& commander, const std::string& picture,
                                                   const Recorded& then, const std::string& root) {
  RecordedFrames out;
  out.missing_ = then.missing;
  out.moved_ = !root.empty();
  SequenceRequest request;
  request.path = fmt::format("{} (quell:sequence)", picture);
  request.text = then.sequence;
  if (!root.empty()) request.root = root;
  // Whether a frame is there decides how others are read, so then all must be looked for.
  std::optional<std::string> frames;
  if (then.missing == "error" || then.missing == "skip")
    frames = then.first == then.frame ? fmt::format("{}", then.frame) : fmt::format("{}-{}", then.first, then.frame);
  request.frames = frames;
  const auto all = json::parse(then.sequence, nullptr, false);
  out.joined_ = all.is_object() && all.contains("quell_joined");
  if (!out.joined_) return out.load_part(commander, request, {}) ? std::optional(std::move(out)) : std::nullopt;
  if (!root.empty())
    throw Error(Exit::usage,
                fmt::format("--root {}: {} was made from several sequences, and one folder cannot be that of all", root,
                            picture));
  try {
    if (all.at("quell_joined") != 1) throw Error(Exit::usage, "its version is unknown");
    for (const auto& j : all.at("parts")) {
      Part part;
      part.roles = j.at("roles").get<std::map<std::string, std::string>>();
      part.still = j.value("still", false);
      request.text = j.at("sequence").dump();
      request.frames = frames;
      if (j.contains("frames")) {
        std::string problem;
        const auto sparse = parse_frame_range(j.at("frames").get<std::string>(), problem);
        if (!sparse) throw Error(Exit::usage, problem);
        part.sparse = *sparse;
      }
      if (part.still || !part.sparse.empty()) request.frames.reset();
      if (!out.load_part(commander, request, std::move(part))) return std::nullopt;
    }
  } catch (const json::exception& e) {
    throw Error(Exit::usage, fmt::format("{}: {}", request.path, e.what()));
  } catch (const std::out_of_range&) {
    throw Error(Exit::usage, fmt::format("{}: names a role that its sequence does not have", request.path));
  }
  if (out.parts_.empty()) throw Error(Exit::usage, fmt::format("{}: joins no sequences", request.path));
  return out;
}

std::map<std::string, int> RecordedFrames::roles() const {
  auto roles = roles_;
  const auto half = roles.find(std::string(kReferenceHalves[0]));
  if (joined_ && half != roles.end()) roles.emplace(kReference, half->second);
  return roles;
}

bool RecordedFrames::reads(const std::string& path, std::int64_t first, std::int64_t last) const {
  const auto whole = [](const std::string& p) { return fs::absolute(p).lexically_normal(); };
  const auto wanted = whole(path);
  for (const auto& part : parts_)
    for (const auto* list : {&part.sequence.inputs, &part.sequence.references})
      for (const auto& input : *list)
        for (auto frame = first; frame <= last; ++frame)
          if (whole(input.file.path(frame)) == wanted) return true;
  return false;
}

std::unique_ptr<FrameSource> RecordedFrames::open(Commander& commander, const Part& part,
                                                  const std::vector<std::string>& roles, int threads,
                                                  const std::atomic<bool>* cancel) const {
  SequenceOptions options;
  options.missing = missing_;
  try {
    return commander.open(part.sequence, options, roles, threads, cancel);
  } catch (const Error& e) {
    if (e.exit() != Exit::input || moved_) throw;
    const auto where = part.sequence.root.string();
    throw Error(e.exit(), joined_ ? fmt::format("{}\n  it was in {}", e.what(), where)
                                  : fmt::format("{}\n  --root FOLDER says where its files are now; they were in {}",
                                                e.what(), where));
  }
}

std::unique_ptr<FrameSource> RecordedFrames::open(Commander& commander, const std::vector<std::string>& roles,
                                                  int threads, const std::atomic<bool>* cancel) const {
  if (!joined_) return open(commander, parts_[0], roles, threads, cancel);
  std::vector<JoinedSource::Part> parts;
  for (const auto& part : parts_) {
    std::vector<std::string> here, theirs;
    for (const auto& [ours, their] : part.roles) here.push_back(ours), theirs.push_back(their);
    auto source = open(commander, part, theirs, threads, cancel);
    if (!source) return nullptr;
    const auto label = here.empty() ? std::string("its frames") : fmt::format("its {}", fmt::join(here, ", "));
    parts.push_back({label, std::move(source), part.roles, part.still, part.sparse});
  }
  return with_mean_of_halves(std::make_unique<JoinedSource>(std::move(parts)));
}

}  // namespace quell
