// Hands each role to the source that gives it.
#include "core/lab/joined_source.h"

#include "core/image/image.h"
#include "core/report/error.h"

#include <fmt/format.h>

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
