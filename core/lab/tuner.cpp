// Scores points of a search by running a graph, each point once.
#include "core/lab/tuner.h"

#include "core/graph/write.h"
#include "core/lab/edits.h"
#include "core/lab/group_run.h"
#include "core/lab/range.h"
#include "core/lab/summary.h"
#include "core/lab/threshold.h"
#include "core/report/error.h"
#include "core/run/provenance.h"
#include "core/sequence/file_hash.h"
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

// Sets a parameter in a graph's edits, whatever they set it to before.
void set(Json& all, const TunedParameter& p, double value) {
  all.kind = Json::Kind::object;
  auto it = std::ranges::find(all.members, "set", &JsonMember::key);
  if (it == all.members.end()) {
    Json set;
    set.kind = Json::Kind::object;
    all.members.push_back({"set", {}, std::move(set)});
    it = all.members.end() - 1;
  }
  std::erase_if(it->value.members, [&](const JsonMember& m) { return m.key == p.name; });
  Json json;
  json.position = p.position;
  json.kind = p.range.integer ? Json::Kind::integer : Json::Kind::number;
  json.number = value;
  if (p.range.integer) json.integer = std::int64_t(value);
  it->value.members.push_back({p.name, p.position, std::move(json)});
}

// What a parameter is in the graph itself, whichever node it belongs to: that which differs between two others. None
// where it reaches no number of a node.
std::optional<double> own_value(const Graph& own, const Graph& one, const Graph& other) {
  if (own.nodes.size() != one.nodes.size() || own.nodes.size() != other.nodes.size()) return std::nullopt;
  for (std::size_t n = 0; n < own.nodes.size(); ++n) {
    const auto params = own.nodes[n].type().params();
    for (int p = 0; p < int(params.size()); ++p) {
      const auto value = [&](const Graph& graph) -> std::optional<double> {
        const auto& instance = graph.nodes[n].instance;
        if (params[std::size_t(p)].kind == QUELL_INT) return instance.get_int(p);
        if (params[std::size_t(p)].kind == QUELL_FLOAT) return six_digits(double(instance.get_float(p)));
        return std::nullopt;
      };
      if (value(one) != value(other)) return value(own);
    }
  }
  return std::nullopt;
}

struct Frames {
  const StudySequence& declared;
  std::vector<std::int64_t> numbers;

  // What they are frames of.
  std::string origin() const {
    Json source = object_json(declared.position);
    source.members = declared.source;
    return fmt::format("{}\n{}\n{}", declared.path, declared.root.value_or(""), edits_text(source));
  }
};

// Frames that a search saw say nothing of how what it found does on others.
void refuse_seen(std::span<const Frames> seen, const Frames& held_out, Diagnostics& diagnostics) {
  for (const auto& training : seen) {
    if (training.origin() != held_out.origin()) continue;
    const auto frame = std::ranges::find_first_of(held_out.numbers, training.numbers);
    if (frame == held_out.numbers.end()) continue;
    return diagnostics.error(held_out.declared.position, held_out.declared.where,
                             fmt::format("the search sees frame {} of '{}' as {}", *frame, held_out.declared.written,
                                         training.declared.where),
                             {R"(held out is another sequence, other "frames", or another seed in its "source")"});
  }
}

}  // namespace

std::string parameters_text(const Tuning& tuning, std::span<const double> values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{}={:.6g}", i ? " " : "", tuning.parameters[i].name, values[i]);
  return text;
}

Json Tuner::edits(const std::vector<double>& parameters) const {
  Json all = tuning_.training.variants.front().edits;
  for (std::size_t i = 0; i < parameters.size(); ++i) set(all, tuning_.parameters[i], parameters[i]);
  return all;
}

// The graph itself, and with each parameter at both ends of its range.
std::vector<StudyVariant> Tuner::ends() const {
  const auto& own = tuning_.training.variants.front();
  std::vector<StudyVariant> all = {own};
  for (const auto& p : tuning_.parameters)
    for (const double end : {p.range.from, p.range.to}) {
      all.push_back(own);
      all.back().name = p.name;
      set(all.back().edits, p, end);
    }
  return all;
}

void Tuner::start_from(const Trial& trial) {
  for (std::size_t i = 0; i < tuning_.parameters.size(); ++i) {
    const auto& p = tuning_.parameters[i];
    const auto& graphs = trial.variants();
    auto& range = ranges_.emplace_back(p.range);
    const auto own = own_value(graphs[0].plain, graphs[2 * i + 1].plain, graphs[2 * i + 2].plain);
    if (p.start)
      range.start = *p.start;
    else if (own && *own >= range.from && *own <= range.to)
      range.start = *own;
  }
}

bool Tuner::check() {
  const auto variants = ends();
  std::vector<Frames> seen;
  for (const Study* study : {&tuning_.training, tuning_.held_out ? &*tuning_.held_out : nullptr}) {
    if (!study) continue;
    Study tried = *study;
    tried.variants = variants;
    for (const auto& sequence : study->sequences) {
      const auto trial = Trial::load(tried, sequence, false, lab_);
      if (!trial) return false;
      const Frames frames{sequence, trial->sequence().frames};
      study == &tuning_.training ? seen.push_back(frames) : refuse_seen(seen, frames, lab_.diagnostics);
      if (ranges_.empty()) start_from(*trial);
      key_ += trial->identity(std::nullopt, 0) + fingerprint(trial->variants().front().graph);
    }
  }
  key_ = text_hash(tuning_.text + key_);
  return lab_.diagnostics.ok();
}

TunedScore Tuner::score(const Study& study, const Json& edits, const std::string& whose) {
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
    const auto statistic = parse_statistic(name);
    const auto& all = numbers[statistic.metric];
    if (all.empty())
      throw Error(Exit::input,
                  fmt::format("no frame behind the warm-up has a number of the metric '{}'", statistic.metric));
    score.numbers[name] = statistic.of(summarize(all));
  }
  score.value = (*tuning_.minimise)([&](const std::string& name) { return score.numbers.at(name); });
  if (std::isfinite(score.value)) return score;
  std::string numbers_text;
  for (const auto& [name, number] : score.numbers)
    numbers_text += fmt::format("{}{} is {:.6g}", numbers_text.empty() ? "" : ", ", name, number);
  throw Error(Exit::usage,
              fmt::format("{}: '{}' comes to {}\n  {}\n  it has to be a number wherever the search looks: max(…, 1e-6) "
                          "keeps a divisor, a root or a logarithm above 0",
                          whose, tuning_.minimise->text(),
                          std::isnan(score.value) ? "no number"
                          : score.value > 0       ? "infinity"
                                                  : "-infinity",
                          numbers_text));
}

TunedGraph Tuner::graph(const Json& edits) {
  Study tried = tuning_.training;
  tried.variants.front().edits = edits;
  const auto trial = Trial::load(tried, tried.sequences.front(), false, lab_);
  if (!trial) throw Error(Exit::usage, lab_.diagnostics.format());
  const Group group(tried, *trial, {0}, false);
  const auto source = trial->open(group.roles(), std::nullopt, 0, lab_);
  if (!source) throw Error(lab_.diagnostics.exit(), lab_.diagnostics.format());
  const auto& plain = trial->variants().front().plain;
  return {write_graph(plain, lab_.graphs).text, fingerprint(plain), plugin_versions(group.graph(), *source)};
}

TunedResult Tuner::run() {
  read_journal();
  TunedResult result;
  const Json own = tuning_.training.variants.front().edits;
  result.training_before = score(tuning_.training, own, "the graph itself");
  const auto found = search(ranges_, tuning_.evaluations, tuning_.tolerance, [&](std::span<const double> units) {
    TunedStep step;
    for (std::size_t i = 0; i < units.size(); ++i) step.parameters.push_back(written(units[i], ranges_[i].integer));
    if (const auto it = known_.find(step.parameters); it != known_.end()) {
      step.score = it->second, step.remembered = true;
    } else {
      step.score =
          score(tuning_.training, edits(step.parameters),
                fmt::format("step {}, {}", result.steps.size() + 1, parameters_text(tuning_, step.parameters)));
      known_[step.parameters] = step.score;
      order_.push_back(step.parameters);
      write_journal();
    }
    result.steps.push_back(step);
    if (step.score.value < result.steps[result.best].score.value) result.best = result.steps.size() - 1;
    if (options_.tried) options_.tried(step);
    return step.score.value;
  });
  result.converged = found.converged;
  result.graph = graph(edits(result.steps[result.best].parameters));
  if (tuning_.held_out) {
    result.held_out_before = score(*tuning_.held_out, own, "the graph itself, held out");
    result.held_out_after =
        score(*tuning_.held_out, edits(result.steps[result.best].parameters), "what was found, held out");
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
      score.value = step.at("value").get<double>();
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
