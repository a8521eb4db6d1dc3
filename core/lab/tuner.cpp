// Scores points of a search by running a graph, each point once.
#include "core/lab/tuner.h"

#include "core/lab/digest.h"
#include "core/lab/group_run.h"
#include "core/lab/range.h"
#include "core/lab/summary.h"
#include "core/lab/threshold.h"
#include "core/report/error.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace quell {

using nlohmann::ordered_json;

namespace {

// As it stands in what is written.
double written(double x, bool integer) { return integer ? std::round(x) : six_digits(x); }

class Collect : public FrameSink {
 public:
  explicit Collect(const Group& group) : group_(group) {}
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    group_.take(frame, outputs, std::span(&entry, 1));
  }
  JournalEntry entry;

 private:
  const Group& group_;
};

ordered_json to_json(const std::vector<double>& parameters, const TunedScore& score) {
  return {{"parameters", parameters}, {"value", score.value}, {"numbers", score.numbers}};
}

}  // namespace

Json Tuner::edits(const std::vector<double>& parameters) const {
  Json all = tuning_.training.variants.front().edits;
  all.kind = Json::Kind::object;
  auto it = std::ranges::find(all.members, "set", &JsonMember::key);
  if (it == all.members.end()) {
    Json set;
    set.kind = Json::Kind::object;
    all.members.push_back({"set", {}, std::move(set)});
    it = all.members.end() - 1;
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = tuning_.parameters[i];
    Json value;
    value.position = p.position;
    if (p.range.integer)
      value.kind = Json::Kind::integer, value.integer = std::int64_t(parameters[i]);
    else
      value.kind = Json::Kind::number, value.number = parameters[i];
    std::erase_if(it->value.members, [&](const JsonMember& m) { return m.key == p.name; });
    it->value.members.push_back({p.name, p.position, std::move(value)});
  }
  return all;
}

bool Tuner::check() {
  std::vector<double> first;
  for (const auto& p : tuning_.parameters) first.push_back(written(p.range.start, p.range.integer));
  for (const Study* study : {&tuning_.training, tuning_.held_out ? &*tuning_.held_out : nullptr}) {
    if (!study) continue;
    Study tried = *study;
    tried.variants.front().edits = edits(first);
    for (const auto& sequence : tried.sequences) {
      const auto trial = Trial::load(tried, sequence, false, lab_);
      if (!trial) return false;
      key_ += trial->identity(std::nullopt, 0) + fingerprint(trial->variants().front().graph);
    }
  }
  key_ = digest(tuning_.text + key_);
  return lab_.diagnostics.ok();
}

TunedScore Tuner::score(const Study& study, const Json& edits) {
  Study tried = study;
  tried.variants.front().edits = edits;
  std::map<std::string, std::vector<double>> numbers;
  for (const auto& sequence : tried.sequences) {
    const auto trial = Trial::load(tried, sequence, false, lab_);
    if (!trial) throw Error(Exit::usage, lab_.diagnostics.format());
    const Group group(tried, *trial, {0}, false);
    const auto source = trial->open(group.roles(), std::nullopt, 0, lab_);
    if (!source) throw Error(lab_.diagnostics.exit(), lab_.diagnostics.format());
    Collect sink(group);
    run_graph(group.graph(), *source, sink, options_.run);
    for (auto f = std::size_t(tried.warm_up); f < sink.entry.numbers.size(); ++f)
      for (std::size_t m = 0; m < trial->metrics().size(); ++m)
        if (const auto& number = sink.entry.numbers[f][m]) numbers[trial->metrics()[m].name].push_back(*number);
  }
  TunedScore score;
  for (const auto& name : tuning_.minimise->names()) {
    const auto& all = numbers[metric_of(name)];
    if (all.empty())
      throw Error(Exit::input,
                  fmt::format("no frame behind the warm-up has a number of the metric '{}'", metric_of(name)));
    score.numbers[name] = parse_threshold(name + " > 0", "minimise").of(summarize(all));
  }
  score.value = (*tuning_.minimise)([&](const std::string& name) { return score.numbers.at(name); });
  return score;
}

TunedResult Tuner::run() {
  read_journal();
  TunedResult result;
  const Json own = tuning_.training.variants.front().edits;
  result.training_before = score(tuning_.training, own);
  std::vector<SearchRange> ranges;
  for (const auto& p : tuning_.parameters) ranges.push_back(p.range);
  const auto found = search(ranges, tuning_.evaluations, tuning_.tolerance, [&](std::span<const double> units) {
    TunedStep step;
    for (std::size_t i = 0; i < units.size(); ++i) step.parameters.push_back(written(units[i], ranges[i].integer));
    if (const auto it = known_.find(step.parameters); it != known_.end()) {
      step.score = it->second, step.remembered = true;
    } else {
      step.score = score(tuning_.training, edits(step.parameters));
      known_[step.parameters] = step.score;
      order_.push_back(step.parameters);
      write_journal();
    }
    result.steps.push_back(step);
    if (!(result.steps[result.best].score.value <= step.score.value)) result.best = result.steps.size() - 1;
    if (options_.tried) options_.tried(step);
    return step.score.value;
  });
  result.converged = found.converged;
  if (tuning_.held_out) {
    result.held_out_before = score(*tuning_.held_out, own);
    result.held_out_after = score(*tuning_.held_out, edits(result.steps[result.best].parameters));
  }
  return result;
}

// A journal of another tuning, or of other files, is as good as none.
void Tuner::read_journal() {
  std::ifstream file(options_.journal);
  if (!file) return;
  const auto j = ordered_json::parse(file, nullptr, false);
  if (!j.is_object() || j.value("key", "") != key_) return;
  try {
    for (const auto& step : j.at("steps")) {
      TunedScore score;
      score.value = step.at("value").is_null() ? std::nan("") : step.at("value").get<double>();
      score.numbers = step.at("numbers").get<std::map<std::string, double>>();
      auto parameters = step.at("parameters").get<std::vector<double>>();
      order_.push_back(parameters);
      known_[std::move(parameters)] = std::move(score);
    }
  } catch (const ordered_json::exception&) {
    known_.clear(), order_.clear();
  }
}

void Tuner::write_journal() const {
  ordered_json j = {{"key", key_}, {"steps", ordered_json::array()}};
  for (const auto& parameters : order_) j["steps"].push_back(to_json(parameters, known_.at(parameters)));
  write_file(options_.journal.string(), j.dump(1) + "\n");
}

}  // namespace quell
