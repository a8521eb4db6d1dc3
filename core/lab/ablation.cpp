// One sequence and seed after the other; of each, all variants that the journal lacks.
#include "core/lab/ablation.h"

#include "core/graph/write.h"
#include "core/lab/edits.h"
#include "core/report/error.h"
#include "core/run/memory_limit.h"
#include "core/sequence/file_hash.h"
#include "core/sequence/frame_range.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>

namespace quell {

namespace fs = std::filesystem;

namespace {

std::string seed_name(const Study& study, std::size_t seed) {
  return study.seeds ? std::to_string(study.seeds->values[seed]) : "own";
}

class StudyRun {
 public:
  StudyRun(const Study& study, const std::vector<Trial>& trials, Laboratory& lab, const AblationOptions& options)
      : study_(study), trials_(trials), lab_(lab), options_(options) {}

  Ablation run() {
    describe();
    for (std::size_t s = 0; s < trials_.size(); ++s) total_ += seeds() * trials_[s].sequence().frames.size();
    for (std::size_t s = 0; s < trials_.size(); ++s) {
      out_.results.numbers.emplace_back();
      spent_.assign(study_.variants.size(), {});
      for (std::size_t seed = 0; seed < seeds(); ++seed) run_one(s, seed);
      for (std::size_t v = 0; v < spent_.size(); ++v) {
        out_.times[v].own_of.push_back(summarize(spent_[v]).median);
        out_.times[v].own += out_.times[v].own_of.back() * double(spent_[v].size());
      }
    }
    double frames = 0;
    for (const auto& trial : trials_) frames += double(seeds() * trial.sequence().frames.size());
    for (auto& times : out_.times) times.own /= frames, times.judged /= frames;
    return std::move(out_);
  }

 private:
  std::size_t seeds() const { return study_.seeds ? study_.seeds->values.size() : 1; }

  void describe() {
    auto& r = out_.results;
    r.name = study_.name, r.about = study_.about, r.version = options_.version, r.simd = options_.simd;
    r.warm_up = study_.warm_up;
    if (study_.seeds) r.seeds = study_.seeds->values;
    for (const auto& m : trials_[0].metrics())
      r.metrics.push_back({m.name, m.title, m.key.unit, m.key.higher_is_better, m.key.perfect});
    const auto own = own_nodes();
    for (std::size_t v = 0; v < study_.variants.size(); ++v) {
      const auto& declared = study_.variants[v];
      const auto& graph = trials_[0].variants()[v];
      r.variants.push_back({declared.name, declared.about, edits_text(declared.edits),
                            write_graph(graph.plain, lab_.graphs).text, fingerprint(graph.plain),
                            run_command(study_, declared), int(graph.plain.nodes.size()), own[v], declared.baseline});
    }
    out_.times.resize(study_.variants.size());
  }

  // Nodes of each variant that no other shares; and how many there are in all.
  std::vector<int> own_nodes() {
    std::vector<std::size_t> all(study_.variants.size());
    std::iota(all.begin(), all.end(), std::size_t(0));
    const Group group(study_, trials_[0], all, false);
    out_.merged_nodes = group.graph().nodes.size();
    for (const auto& variant : trials_[0].variants()) out_.all_nodes += variant.graph.nodes.size();
    return group.unshared();
  }

  // ---- One sequence with one seed ----

  StudyImages images_of(std::size_t s) const {
    const auto& frames = trials_[s].sequence().frames;
    StudyImages images{options_.folder / "images" / study_.sequences[s].name, {}};
    if (options_.images == WrittenImages::all) {
      images.frames.insert(frames.begin(), frames.end());
    } else {
      const auto first = std::min(std::size_t(study_.warm_up), frames.size() - 1);
      for (const auto i : {first, first + (frames.size() - 1 - first) / 2, frames.size() - 1})
        images.frames.insert(frames[i]);
    }
    return images;
  }

  // Of each variant, everything that decides its numbers.
  std::vector<std::string> keys_of(std::size_t s, std::size_t seed) const {
    std::string common =
        fmt::format("quell {} {}\n{}", options_.version, options_.simd, trials_[s].identity(study_.seeds, seed));
    for (const auto& metric : trials_[s].metrics()) common += fmt::format("metric {}\n", metric.name);
    std::vector<std::string> keys;
    for (const auto& variant : trials_[s].variants())
      keys.push_back(text_hash(common + fingerprint_text(variant.graph)));
    return keys;
  }

  // Images of one variant, and of what all variants see, that are listed and have gone.
  bool images_there(const Trial& trial, const StudyImages& images, std::size_t variant) const {
    const auto listed = images.list(study_, trial, 0, options_.folder);
    return std::ranges::all_of(listed, [&](const ResultImage& image) {
      return (image.variant && *image.variant != variant) || fs::exists(options_.folder / image.file);
    });
  }

  void run_one(std::size_t s, std::size_t seed) {
    const auto& trial = trials_[s];
    const auto count = study_.variants.size();
    const Journal journal(options_.folder / "journal" / study_.sequences[s].name / seed_name(study_, seed));
    const auto images = images_of(s);
    const auto keys = keys_of(s, seed);
    const auto entry = [&](std::size_t v) {
      auto found = journal.finished(study_.variants[v].name, keys[v]);
      return found && (seed > 0 || images_there(trial, images, v)) ? std::move(found) : std::nullopt;
    };

    std::vector<std::size_t> pending;
    for (std::size_t v = 0; v < count; ++v)
      if (!entry(v)) pending.push_back(v);
    const auto frames = trial.sequence().frames.size();
    auto started = part_of(journal, keys);
    auto source = open(trial, seed);
    FileLog log(*source);
    if (started && !log.take(started->files)) started.reset();
    if (s == out_.results.sequences.size()) add_sequence(trial, *source, images);
    if (pending.empty()) total_ -= frames;
    bool first = true;
    const auto run_group_of = [&](const std::vector<std::size_t>& variants, JournalPart part) {
      if (!std::exchange(first, false)) total_ += frames;
      const Group group(study_, trial, variants, seed == 0);
      const Provenance::Run made{options_.command, options_.simd, "error", {}, lab_.graphs};
      std::optional<StudyImageWriter> writer;
      if (seed == 0)
        writer.emplace(study_, trial, images, group.shown(),
                       StudyImageWriter::Made{*source, log, made, {{"quell:study", study_.name}}});
      GroupOptions options{options_.run, writer ? &*writer : nullptr, &log, {}};
      options.run.overlap = false;  // so that times are those of the nodes alone
      total_ -= part.entries.front().numbers.size();
      options.done = [&](std::int64_t frame) { options_.progress({frame, ++done_, total_}); };
      run_group(group, *source, std::move(part), journal, options);
    };
    if (started) {
      std::vector<std::size_t> variants;
      for (const auto& e : started->entries)
        variants.push_back(
            std::size_t(std::ranges::find(study_.variants, e.variant, &StudyVariant::name) - study_.variants.begin()));
      const auto at = started->entries.front().numbers.size();
      if (at < frames)
        options_.say(fmt::format("{}: going on with frame {}", study_.sequences[s].name, trial.sequence().frames[at]));
      run_group_of(variants, *started);
      std::erase_if(pending, [&](std::size_t v) { return std::ranges::find(variants, v) != variants.end(); });
    }
    for (const auto& variants : groups(trial, pending, *source, seed == 0)) {
      JournalPart part;
      for (const auto v : variants) part.entries.push_back({study_.variants[v].name, keys[v], {}, {}, 0, 0});
      run_group_of(variants, std::move(part));
    }
    collect(s, journal, keys);
  }

  // A merged run that was ended before its end, if its variants are still what they were.
  std::optional<JournalPart> part_of(const Journal& journal, const std::vector<std::string>& keys) const {
    auto part = journal.part();
    if (!part || part->entries.empty()) return std::nullopt;
    for (const auto& e : part->entries) {
      const auto it = std::ranges::find(study_.variants, e.variant, &StudyVariant::name);
      if (it == study_.variants.end() || keys[std::size_t(it - study_.variants.begin())] != e.key) return std::nullopt;
      if (e.numbers.size() != part->entries.front().numbers.size()) return std::nullopt;
    }
    return part;
  }

  std::unique_ptr<FrameSource> open(const Trial& trial, std::size_t seed) {
    auto source = trial.open(trial.all_roles(), study_.seeds, seed, lab_);
    if (!source || !lab_.diagnostics.ok()) throw Error(lab_.diagnostics.exit(), lab_.diagnostics.format());
    return source;
  }

  void add_sequence(const Trial& trial, FrameSource& source, const StudyImages& images) {
    const auto s = out_.results.sequences.size();
    const auto& declared = trial.declared();
    const auto& graph = trial.variants()[0].graph;
    const std::string role = trial.roles().contains("color") ? "color" : graph.inputs[0].name;
    const auto shape = source.shapes(source.frames()[0], std::span(&role, 1))[0];
    out_.results.sequences.push_back({declared.name, declared.written, shape.width, shape.height, source.frames()});
    const auto listed = images.list(study_, trial, s, options_.folder);
    out_.results.images.insert(out_.results.images.end(), listed.begin(), listed.end());
  }

  // All together where memory suffices, else halves of them, and so on.
  std::vector<std::vector<std::size_t>> groups(const Trial& trial, const std::vector<std::size_t>& variants,
                                               FrameSource& source, bool images) {
    std::vector<std::vector<std::size_t>> all;
    if (!variants.empty()) split(trial, variants, source, images, all);
    if (all.size() > 1)
      options_.say(fmt::format("{}: {} variants in {} groups, for --max-memory has no room for all at once",
                               trial.declared().name, variants.size(), all.size()));
    return all;
  }

  void split(const Trial& trial, const std::vector<std::size_t>& variants, FrameSource& source, bool images,
             std::vector<std::vector<std::size_t>>& all) {
    if (options_.run.max_memory && variants.size() > 1) {
      const Group group(study_, trial, variants, images);
      const auto shapes = source.shapes(source.frames()[0], group.roles());
      if (Plan(group.graph(), shapes, {false, false}).bytes() > options_.run.max_memory) {
        const auto middle = variants.begin() + std::ptrdiff_t(variants.size() / 2);
        split(trial, {variants.begin(), middle}, source, images, all);
        split(trial, {middle, variants.end()}, source, images, all);
        return;
      }
    }
    all.push_back(variants);
  }

  void collect(std::size_t s, const Journal& journal, const std::vector<std::string>& keys) {
    auto& of_seed = out_.results.numbers[s].emplace_back();
    for (std::size_t v = 0; v < study_.variants.size(); ++v) {
      auto entry = journal.finished(study_.variants[v].name, keys[v]);
      if (!entry || entry->numbers.size() != trials_[s].sequence().frames.size())
        throw Error(Exit::resources, fmt::format("the journal in {} lost variant '{}'", options_.folder.string(),
                                                 study_.variants[v].name));
      auto& spent = spent_[v];
      spent.insert(spent.end(), entry->own_seconds.begin(), entry->own_seconds.end());
      out_.times[v].judged += entry->judged_seconds;
      out_.alone += std::accumulate(entry->own_seconds.begin(), entry->own_seconds.end(), entry->judged_seconds);
      out_.spent += entry->shared_seconds;
      of_seed.push_back(std::move(entry->numbers));
    }
  }

  const Study& study_;
  const std::vector<Trial>& trials_;
  Laboratory& lab_;
  const AblationOptions& options_;
  Ablation out_;
  std::vector<std::vector<double>> spent_;  // by variant: own seconds of every frame of the current sequence
  std::size_t done_ = 0, total_ = 0;        // frames of this process
};

}  // namespace

std::optional<std::vector<Trial>> load_trials(const Study& study, bool maps, Laboratory& lab) {
  std::vector<Trial> trials;
  for (const auto& sequence : study.sequences) {
    auto trial = Trial::load(study, sequence, maps, lab);
    if (trial) trials.push_back(std::move(*trial));
  }
  if (trials.size() != study.sequences.size()) return std::nullopt;
  for (const auto& trial : trials) trial.check_frames(lab);
  return trials;
}

Ablation run_study(const Study& study, const std::vector<Trial>& trials, Laboratory& lab,
                   const AblationOptions& options) {
  return StudyRun(study, trials, lab, options).run();
}

void write_variants(const Study& study, const Trial& trial, const Laboratory& lab, const fs::path& folder) {
  for (std::size_t v = 0; v < study.variants.size(); ++v) {
    write_file((folder / (study.variants[v].name + ".json")).string(),
               write_graph(trial.variants()[v].plain, lab.graphs).text);
  }
}

std::string timings_json(const Ablation& a, int threads) {
  nlohmann::ordered_json j = {{"quell_timings", 1}, {"simd", a.results.simd}, {"threads", threads}};
  auto& variants = j["variants"] = nlohmann::ordered_json::array();
  for (std::size_t v = 0; v < a.times.size(); ++v) {
    const auto& times = a.times[v];
    auto& variant = variants.emplace_back();
    variant = {{"name", a.results.variants[v].name}, {"cost_ms", times.own * 1e3}};
    for (std::size_t s = 0; s < times.own_of.size(); ++s)
      variant["cost_ms_of"][a.results.sequences[s].name] = times.own_of[s] * 1e3;
    variant["metrics_ms"] = times.judged * 1e3;
  }
  j["saving"] = {{"nodes", a.merged_nodes},
                 {"nodes_of_separate_runs", a.all_nodes},
                 {"seconds", a.spent},
                 {"seconds_of_separate_runs", a.alone}};
  return j.dump(2) + "\n";
}

}  // namespace quell
