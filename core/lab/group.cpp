// One merged graph for several variants, and what its outputs mean.
#include "core/lab/group_run.h"

#include "core/report/error.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quell {

namespace {

const std::string kInput = "color";

// The shortest decimal number that this float is nearest to, so that results read as people would write them.
double written(float number) { return std::stod(fmt::format("{}", number)); }

}  // namespace

Group::Group(const Study& study, const Trial& trial, std::vector<std::size_t> variants, bool images)
    : study_(&study), trial_(&trial), variants_(std::move(variants)) {
  std::vector<MergePart> parts;
  std::size_t outputs = 0;
  for (const auto v : variants_) {
    const auto& graph = trial.variants()[v].graph;
    parts.push_back({study.variants[v].name, &graph});
    first_output_.push_back(outputs);
    outputs += graph.outputs.size();
  }
  const auto show = [&](const std::string& role) {
    seen_.inputs.push_back({role, QUELL_RADIANCE, false});
    seen_.outputs.push_back({role, {{Source::kInput, int(seen_.inputs.size()) - 1}, 0, {}}, QUELL_RADIANCE, true});
  };
  if (const auto it = trial.roles().find(kInput); images && it != trial.roles().end() && it->second == QUELL_RADIANCE)
    show(kInput);
  if (images && !trial.reference_frames().empty()) show(std::string(kReference));
  if (!seen_.outputs.empty()) parts.push_back({"", &seen_});
  merged_ = merge(parts);

  users_.assign(merged_.graph.nodes.size(), 0);
  for (std::size_t p = 0; p < variants_.size(); ++p) {
    const auto& places = merged_.places[p];
    const auto own_end = places.begin() + std::ptrdiff_t(trial.variants()[variants_[p]].plain.nodes.size());
    std::set<int> own(places.begin(), own_end), judging;
    for (auto it = own_end; it != places.end(); ++it)
      if (!own.contains(*it)) judging.insert(*it);
    own_.emplace_back(own.begin(), own.end());
    judging_.emplace_back(judging.begin(), judging.end());
    for (const auto* nodes : {&own_.back(), &judging_.back()})
      for (const int n : *nodes) ++users_[std::size_t(n)];
  }
}

std::vector<int> Group::unshared() const {
  std::vector<int> owners(merged_.graph.nodes.size(), 0), counts;
  for (const auto& own : own_)
    for (const int n : own) ++owners[std::size_t(n)];
  for (const auto& own : own_)
    counts.push_back(int(std::ranges::count_if(own, [&](int n) { return owners[std::size_t(n)] == 1; })));
  return counts;
}

std::vector<std::string> Group::roles() const {
  std::vector<std::string> roles;
  for (const auto& input : merged_.graph.inputs) roles.push_back(input.name);
  return roles;
}

void Group::take(std::int64_t frame, std::span<const quell_image> outputs, std::span<JournalEntry> entries) const {
  for (std::size_t p = 0; p < variants_.size(); ++p) {
    const auto& judged = trial_->variants()[variants_[p]];
    auto& numbers = entries[p].numbers.emplace_back();
    for (std::size_t m = 0; m < judged.metrics.size(); ++m) {
      const auto number = [&](int output) { return outputs[first_output_[p] + std::size_t(output)].plane[0][0]; };
      const auto& at = judged.metrics[m];
      const bool counts = trial_->judges(m, frame) && (at.pixels < 0 || number(at.pixels) > 0);
      if (!counts) {
        numbers.push_back(std::nullopt);
        continue;
      }
      const float value = number(at.value);
      if (!std::isfinite(value))
        throw Error(Exit::input,
                    fmt::format("{} of variant '{}' is {} in frame {}, which is no finite number",
                                trial_->metrics()[m].name, study_->variants[variants_[p]].name, value, frame));
      numbers.push_back(written(value));
    }
  }
}

std::vector<ShownOutput> Group::shown() const {
  using Kind = ShownOutput::Kind;
  std::vector<ShownOutput> all;
  for (std::size_t p = 0; p < variants_.size(); ++p) {
    const auto& judged = trial_->variants()[variants_[p]];
    all.push_back({Kind::output, first_output_[p] + std::size_t(judged.judged), variants_[p]});
    for (std::size_t m = 0; m < judged.metrics.size(); ++m)
      if (const int map = judged.metrics[m].map; map >= 0)
        all.push_back({Kind::map, first_output_[p] + std::size_t(map), variants_[p], m});
  }
  const std::size_t first = merged_.graph.outputs.size() - seen_.outputs.size();
  for (std::size_t i = 0; i < seen_.outputs.size(); ++i)
    all.push_back({seen_.outputs[i].name == kInput ? Kind::input : Kind::reference, first + i});
  return all;
}

void Group::charge(std::span<const double> busy, std::span<JournalEntry> entries) const {
  for (std::size_t p = 0; p < variants_.size(); ++p) {
    auto& own = entries[p].own_seconds.emplace_back(0);
    for (const int n : own_[p]) own += busy[std::size_t(n)];
    for (const int n : judging_[p]) entries[p].judged_seconds += busy[std::size_t(n)];
    for (const auto* nodes : {&own_[p], &judging_[p]})
      for (const int n : *nodes) entries[p].shared_seconds += busy[std::size_t(n)] / users_[std::size_t(n)];
  }
}

}  // namespace quell
