// Hands each role to the source that gives it.
#include "core/lab/joined_source.h"

#include "core/image/image.h"
#include "core/report/error.h"
#include "core/sequence/frame_range.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace quell {

JoinedSource::JoinedSource(std::vector<Part> parts) : parts_(std::move(parts)) {
  while (lead_ + 1 < parts_.size() && parts_[lead_].still) ++lead_;
  if (parts_[lead_].still) lead_ = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const auto& part = parts_[p];
    const auto& theirs = part.source->frames();
    for (const auto frame : lead().frames())
      if (!part.still && part.sparse.empty() && std::ranges::find(theirs, frame) == theirs.end())
        throw Error(Exit::input, fmt::format("{} has no frame {}, which {} has; --frames picks those that both have",
                                             part.label, frame, parts_[lead_].label));
    for (const auto& [here, there] : part.roles) {
      if (!part_of_.emplace(here, p).second)
        throw Error(Exit::usage,
                    fmt::format("both {} and {} give '{}'", parts_[part_of_[here]].label, part.label, here));
      roles_[here] = part.source->roles().at(there);
    }
  }
}

bool JoinedSource::has(const Part& part, std::int64_t frame) {
  return part.still || part.sparse.empty() || std::ranges::find(part.sparse, frame) != part.sparse.end();
}

bool JoinedSource::has(std::int64_t frame, const std::string& role) const {
  return has(parts_[part_of_.at(role)], frame);
}

template <class Use>
void JoinedSource::split(std::span<const std::string> roles, Use use) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    std::vector<std::string> names;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < roles.size(); ++i)
      if (part_of_.at(roles[i]) == p) names.push_back(parts_[p].roles.at(roles[i])), places.push_back(i);
    if (names.empty()) continue;
    try {
      use(parts_[p], names, places);
    } catch (const Error& e) {
      throw Error(e.exit(), fmt::format("{}: {}", parts_[p].label, e.what()));
    }
  }
}

std::vector<quell_shape> JoinedSource::shapes(std::int64_t frame, std::span<const std::string> roles) {
  std::vector<quell_shape> all(roles.size());
  split(roles, [&](const Part& part, const auto& names, const auto& places) {
    // A frame that is missing is as large as the next that is not.
    auto at = part.still ? part.source->frames().front() : frame;
    if (!has(part, frame)) {
      const auto next = std::ranges::find_if(part.sparse, [&](std::int64_t f) { return f > frame; });
      at = next == part.sparse.end() ? part.sparse.back() : *next;
    }
    const auto some = part.source->shapes(at, names);
    for (std::size_t i = 0; i < some.size(); ++i) all[places[i]] = some[i];
  });
  return all;
}

void JoinedSource::read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
  reading_ = frame;
  split(roles, [&](const Part& part, const auto& names, const auto& places) {
    if (!has(part, frame)) {
      for (const auto place : places) fill_missing(into[place], roles_.at(roles[place]));
      return;
    }
    std::vector<quell_image> some;
    for (const auto place : places) some.push_back(into[place]);
    part.source->read(part.still ? part.source->frames().front() : frame, names, some);
  });
}

void JoinedSource::refuse_non_finite(std::span<const std::string> roles) {
  split(roles, [](const Part& part, const auto& names, const auto&) { part.source->refuse_non_finite(names); });
}

template <class Use>
void JoinedSource::each_used(std::span<const std::string> roles, Use use) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    std::map<std::string, std::string> used;
    for (const auto& [here, there] : parts_[p].roles)
      if (std::ranges::find(roles, here) != roles.end()) used[here] = there;
    if (!used.empty() || p == lead_) use(parts_[p], used);
  }
}

std::string JoinedSource::description(const std::filesystem::path& graphs, std::span<const std::string> roles) const {
  using J = nlohmann::ordered_json;
  J parts = J::array();
  bool known = true, plain = true;  // plain: the first that moves can stand for all
  each_used(roles, [&](const Part& part, const auto& used) {
    std::vector<std::string> theirs;
    for (const auto& [here, there] : used) theirs.push_back(there), plain &= here == there;
    // One that only says which frames there are is described by all that it gives.
    if (used.empty())
      for (const auto& [here, there] : part.roles) theirs.push_back(there);
    plain &= &part.source == &parts_[lead_].source && !part.still;
    const auto own = part.source->description(graphs, theirs);
    known &= !own.empty();
    J j{{"roles", used}};
    if (part.still) j["still"] = true;
    if (!part.sparse.empty()) j["frames"] = frame_range_text(part.sparse);
    j["sequence"] = J::parse(own, nullptr, false);
    parts.push_back(std::move(j));
  });
  if (!known) return "";
  return plain ? parts[0]["sequence"].dump() : J{{"quell_joined", 1}, {"parts", parts}}.dump();
}

std::map<std::string, std::string> JoinedSource::plugins(std::span<const std::string> roles) const {
  std::map<std::string, std::string> all;
  each_used(roles, [&](const Part& part, const auto& used) {
    std::vector<std::string> theirs;
    for (const auto& [here, there] : used) theirs.push_back(there);
    all.merge(part.source->plugins(theirs));
  });
  return all;
}

std::string JoinedSource::told_name(std::size_t part, const FileRead& read) const {
  return part == lead_ ? read.name : fmt::format("{}: {}", fmt::join(read.roles, ", "), read.name);
}

void JoinedSource::watch_files(FileWatcher watcher) {
  for (std::size_t p = 0; p < parts_.size(); ++p)
    parts_[p].source->watch_files([this, p, watcher](const FileRead& read) {
      FileRead here = read;
      here.frame = reading_, here.roles.clear();
      for (const auto& [ours, theirs] : parts_[p].roles)
        if (std::ranges::find(read.roles, theirs) != read.roles.end()) here.roles.push_back(ours);
      here.name = told_name(p, {here.frame, read.name, read.hash, here.roles});
      watcher(here);
    });
}

std::map<std::string, Repairs> JoinedSource::repairs() const {
  std::map<std::string, Repairs> all;
  for (const auto& part : parts_) {
    const auto some = part.source->repairs();
    for (const auto& [here, there] : part.roles)
      if (const auto it = some.find(there); it != some.end()) all[here] = it->second;
  }
  return all;
}

}  // namespace quell
