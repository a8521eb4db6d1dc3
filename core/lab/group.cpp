// One merged graph for several variants, and what its outputs mean.
#include "core/lab/group_run.h"

#include "core/report/error.h"
#include "core/sequence/image_writer.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace quell {

namespace {

const std::string kInput = "color";

std::string frame_text(std::int64_t frame) { return fmt::format("{:04}", frame); }

// Frames before the current one whose references enter a metric's number; 64 at most, as through a loop.
int frames_back(const Graph& metric) {
  constexpr int kMost = 64;
  constexpr int kNever = -1;
  // By node: the most frames back that a reference is read, kNever where none is.
  std::vector<int> back(metric.nodes.size(), kNever);
  const auto of = [&](const Source& s) {
    if (s.node >= 0) return back[std::size_t(s.node)];
    return s.node == Source::kInput && is_reference(metric.inputs[std::size_t(s.port)].name) ? 0 : kNever;
  };
  const auto through = [&](const Wire& w) {
    const int from = of(w.from);
    return from == kNever ? of(w.start) : std::min(kMost, from + w.delay);
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t n = 0; n < metric.nodes.size(); ++n)
      for (const auto& port : metric.nodes[n].in)
        for (const auto& wire : port)
          if (const int b = through(wire); b > back[n]) back[n] = b, changed = true;
  }
  int most = kNever;
  for (const auto& out : metric.outputs) most = std::max(most, through(out.wire));
  return most;
}

// The shortest decimal number that this float is nearest to, so that results read as people would write them.
double written(float number) { return std::stod(fmt::format("{}", number)); }

}  // namespace

std::string StudyImages::output(const std::string& variant, std::int64_t frame) const {
  return (folder / fmt::format("{}.{}.exr", variant, frame_text(frame))).string();
}
std::string StudyImages::map(const std::string& metric, const std::string& variant, std::int64_t frame) const {
  return (folder / "maps" / metric / fmt::format("{}.{}.exr", variant, frame_text(frame))).string();
}
std::string StudyImages::input(std::int64_t frame) const {
  return (folder / fmt::format("{}.input.exr", frame_text(frame))).string();
}
std::string StudyImages::reference(std::int64_t frame) const {
  return (folder / fmt::format("{}.reference.exr", frame_text(frame))).string();
}

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
  for (const auto& metric : trial.metrics()) looks_back_.push_back(frames_back(metric.graph));
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

// Whether all references are there that the number of this frame is made from.
bool Group::judged_by_reference(std::size_t metric, std::int64_t frame, const std::set<std::int64_t>& with) const {
  const auto& frames = trial_->sequence().frames;
  const auto at = std::ranges::find(frames, frame) - frames.begin();
  for (std::ptrdiff_t i = at; i >= 0 && i >= at - looks_back_[metric]; --i)
    if (!with.contains(frames[std::size_t(i)])) return looks_back_[metric] < 0;
  return true;
}

void Group::take(std::int64_t frame, std::span<const quell_image> outputs, const std::set<std::int64_t>& with,
                 std::span<JournalEntry> entries) const {
  for (std::size_t p = 0; p < variants_.size(); ++p) {
    const auto& judged = trial_->variants()[variants_[p]];
    auto& numbers = entries[p].numbers.emplace_back();
    for (std::size_t m = 0; m < judged.metrics.size(); ++m) {
      const auto number = [&](int output) { return outputs[first_output_[p] + std::size_t(output)].plane[0][0]; };
      const auto& at = judged.metrics[m];
      const bool counts = judged_by_reference(m, frame, with) && (at.pixels < 0 || number(at.pixels) > 0);
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

void Group::write(std::int64_t frame, std::span<const quell_image> outputs, const StudyImages& images,
                  const std::map<std::string, std::string>& metadata) const {
  if (!images.frames.contains(frame)) return;
  WriteOptions options;
  for (std::size_t p = 0; p < variants_.size(); ++p) {
    const auto& judged = trial_->variants()[variants_[p]];
    const auto& name = study_->variants[variants_[p]].name;
    const auto image = [&](int output) { return outputs[first_output_[p] + std::size_t(output)]; };
    options.metadata = metadata;
    if (!images.attributes.empty())
      options.metadata.insert(images.attributes[variants_[p]].begin(), images.attributes[variants_[p]].end());
    write_image(images.output(name, frame), image(judged.judged), QUELL_RADIANCE, options);
    for (std::size_t m = 0; m < judged.metrics.size(); ++m)
      if (const int map = judged.metrics[m].map; map >= 0)
        write_image(images.map(trial_->metrics()[m].name, name, frame), image(map), QUELL_SCALAR, options);
  }
  options.metadata = metadata;
  const std::size_t first = outputs.size() - seen_.outputs.size();
  for (std::size_t i = 0; i < seen_.outputs.size(); ++i) {
    const bool input = seen_.outputs[i].name == kInput;
    if (input || trial_->reference_frames().contains(frame))
      write_image(input ? images.input(frame) : images.reference(frame), outputs[first + i], QUELL_RADIANCE, options);
  }
}

void Group::charge(std::span<const double> busy, std::span<JournalEntry> entries) const {
  for (std::size_t p = 0; p < variants_.size(); ++p) {
    for (const int n : own_[p]) entries[p].own_seconds += busy[std::size_t(n)];
    for (const int n : judging_[p]) entries[p].judged_seconds += busy[std::size_t(n)];
    for (const auto* nodes : {&own_[p], &judging_[p]})
      for (const int n : *nodes) entries[p].shared_seconds += busy[std::size_t(n)] / users_[std::size_t(n)];
  }
}

}  // namespace quell
