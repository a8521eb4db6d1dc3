// Loads what a study names, for one sequence, and says of every mistake which variant or metric it belongs to.
#include "core/lab/trial.h"

#include "core/lab/halves.h"
#include "core/lab/joined_source.h"
#include "core/lab/kept_source.h"
#include "core/report/suggest.h"
#include "core/run/node_source.h"
#include "core/run/plan.h"
#include "core/run/source_node.h"
#include "core/sequence/file_sequence.h"
#include "core/sequence/frame_range.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace quell {

namespace fs = std::filesystem;

namespace {

// What went wrong while one thing of a study was loaded: its errors stand at that thing where they stand nowhere else,
// and a note says whose they are. What a graph warns of it warns of wherever it is used, so that is left out here.
class Scoped {
 public:
  Scoped(Diagnostics& outer, TextPosition position, std::string where, std::string whose)
      : outer_(outer), position_(position), where_(std::move(where)), whose_(std::move(whose)) {
    inner.sources = std::move(outer.sources);
  }
  ~Scoped() {
    outer_.sources = std::move(inner.sources);
    for (const auto& d : inner.list()) {
      if (d.severity == Severity::warning) continue;
      auto notes = d.notes;
      std::erase(notes, "");
      notes.push_back(whose_);
      const bool nowhere = d.position.source < 0;
      outer_.error(nowhere ? position_ : d.position, nowhere && d.path.empty() ? where_ : d.path, d.text,
                   std::move(notes), d.exit);
    }
  }
  Scoped(const Scoped&) = delete;
  Scoped& operator=(const Scoped&) = delete;

  Diagnostics inner;

 private:
  Diagnostics& outer_;
  TextPosition position_;
  std::string where_, whose_;
};

GraphRequest request_of(const StudyVariant& variant, const Laboratory& lab) {
  GraphRequest request;
  request.graph = variant.graph;
  request.graphs = lab.graphs;
  if (!variant.edits.members.empty()) request.laid_over = variant.edits;
  return request;
}

// Not by what they hold: every frame would have to be read before it is known that none is needed.
std::string describe(const SequenceInput& input, std::span<const std::int64_t> frames) {
  std::string text = fmt::format("{}\n", input.role);
  for (const auto frame : frames) {
    const fs::path path = input.file.path(frame);
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (error) continue;
    const auto time = fs::last_write_time(path, error).time_since_epoch().count();
    text += fmt::format("  {} {} {}\n", fs::absolute(path, error).lexically_normal().string(), size, time);
    if (!input.file.numbered()) break;
  }
  return text;
}

}  // namespace

std::optional<Trial> Trial::load(const Study& study, const StudySequence& declared, bool maps, Laboratory& lab) {
  Trial trial(study, declared);
  if (!trial.load_frames(lab)) {
    trial.look_at_names(lab);
    return std::nullopt;
  }
  trial.look_for_reference();
  const bool metrics = trial.load_metrics(lab);
  if (!trial.load_variants(maps, lab) || !metrics || !trial.judges_some_frame(lab)) return std::nullopt;
  return trial;
}

// What can be said of metrics and graphs without a sequence, so that it is said together with what is wrong with that.
void Trial::look_at_names(Laboratory& lab) const {
  for (const auto& m : study_->metrics) {
    Scoped scoped(lab.diagnostics, m.position, m.where, fmt::format("of the metric '{}'", m.name));
    load_metric(m.name, lab.graphs, lab.registry, scoped.inner);
  }
  for (const auto& v : study_->variants) {
    Scoped scoped(lab.diagnostics, v.position, v.where, fmt::format("of the variant '{}'", v.name));
    if (!load_graph(request_of(v, lab), lab.registry, scoped.inner) && &v == &study_->variants.front()) return;
  }
}

bool Trial::judges_some_frame(Laboratory& lab) const {
  const auto frames = sequence_.frames.size();
  if (study_->metrics.empty() || frames > std::size_t(study_->warm_up)) return true;
  lab.diagnostics.error(
      declared_->position, declared_->where,
      fmt::format("the warm-up of {} takes all {} of its frames, so that none is judged", study_->warm_up, frames),
      {fmt::format("\"warm_up\" is {} where the file does not say it; {} is the most for this sequence", kWarmUp,
                   frames - 1)});
  return false;
}

bool Trial::load_frames(Laboratory& lab) {
  const auto& s = *declared_;
  const std::size_t before = lab.diagnostics.errors();
  {
    Scoped scoped(lab.diagnostics, s.position, s.where, fmt::format("of the sequence '{}'", s.name));
    SequenceRequest request;
    request.path = s.path, request.frames = s.frames, request.root = s.root;
    request.profiles = lab.graphs / "profiles";
    auto sequence = load_sequence(request, scoped.inner);
    if (!sequence) return false;
    sequence_ = std::move(*sequence);
  }
  const auto refuse = [&](const std::vector<JsonMember>& set, const char* key, const char* what) {
    if (!set.empty())
      lab.diagnostics.error(set.front().key_position, fmt::format("{}.{}", s.where, key),
                            fmt::format("the sequence '{}' is made of files and has no {} to set", s.name, what));
  };
  if (sequence_.source)
    source_ =
        source_instance(*sequence_.source, {s.source, s.where + ".source."}, lab.registry, lab.graphs, lab.diagnostics);
  else
    refuse(s.source, "source", "node");
  for (const auto& half : sequence_.reference_sources)
    if (auto node = source_instance(half.node, {s.reference, s.where + ".reference."}, lab.registry, lab.graphs,
                                    lab.diagnostics))
      reference_nodes_.emplace(half.role, std::move(*node));
  if (sequence_.reference_sources.empty()) refuse(s.reference, "reference", "node that makes its reference");
  if (lab.diagnostics.errors() != before) return false;
  if (source_)
    for (const auto& port : source_->type().outputs()) roles_[port.name] = port.type;
  else
    for (const auto& input : sequence_.inputs) roles_[input.role] = input.type;
  if (!study_->seeds) return true;
  const auto& seeds = *study_->seeds;
  if (!source_) {
    lab.diagnostics.error(seeds.position, "seeds",
                          fmt::format("the sequence '{}' is made of files: its noise has no seed", s.name));
    return false;
  }
  const int param = source_->type().find_param(seeds.parameter);
  if (param >= 0 && source_->type().params()[std::size_t(param)].kind == QUELL_INT) return true;
  lab.diagnostics.error(seeds.position, "seeds",
                        fmt::format("'{}', which makes the sequence '{}', has no whole number '{}'",
                                    source_->type().name(), s.name, seeds.parameter),
                        {possibilities("it has", seeds.parameter, names_of(source_->type().params()))});
  return false;
}

void Trial::look_for_reference() {
  for (const auto& [role, node] : reference_nodes_) references_.insert(role);
  for (const auto& file : sequence_.references) references_.insert(file.role);
  if (references_.empty()) return;
  references_.emplace(kReference);
  for (const auto frame : sequence_.frames)
    if (std::ranges::all_of(sequence_.references, [&](const SequenceInput& half) {
          std::error_code error;
          return fs::exists(half.file.path(frame), error);
        }))
      reference_frames_.insert(frame);
}

bool Trial::load_metrics(Laboratory& lab) {
  auto roles = roles_;
  roles.emplace(kJudged, QUELL_RADIANCE);
  for (const auto& role : references_) roles.emplace(role, QUELL_RADIANCE);
  const std::size_t before = lab.diagnostics.errors();
  for (const auto& m : study_->metrics) {
    Scoped scoped(lab.diagnostics, m.position, m.where, fmt::format("of the metric '{}'", m.name));
    Diagnostics free;  // loads it for any sequence, to say what this one lacks
    std::swap(free.sources, scoped.inner.sources);
    auto any = load_metric(m.name, lab.graphs, lab.registry, free);
    scoped.inner.sources = std::move(free.sources);
    if (any) {
      bool served = true;
      for (const auto& input : any->graph.inputs) {
        if (roles.contains(input.name) || input.optional) continue;
        served = false;
        std::vector<std::string> names;
        for (const auto& [name, type] : roles)
          if (name != kJudged) names.push_back(name);
        std::vector<std::string> notes = {possibilities("it has", input.name, names)};
        if (is_reference(input.name))
          notes = {references_.empty() ? R"(it comes as "reference" in the sequence)"
                                       : R"(halves come as "reference": { "A": …, "B": … } in the sequence)"};
        scoped.inner.error(
            m.position, m.where,
            fmt::format("'{}' reads '{}', which the sequence '{}' does not have", m.name, input.name, declared_->name),
            std::move(notes));
      }
      if (!served) continue;
      if (reference_frames_.empty() && reference_frames_back(any->graph) >= 0) {
        const auto& files = sequence_.references;
        scoped.inner.error(
            m.position, m.where,
            fmt::format("'{}' judges by a reference, and no frame of '{}' has all its files", m.name, declared_->name),
            {fmt::format("frames are {}; of the first it would be {}", frame_range_text(sequence_.frames),
                         files.front().file.path(sequence_.frames.front()))},
            Exit::input);
        continue;
      }
    }
    auto metric = load_metric(m.name, lab.graphs, lab.registry, scoped.inner, roles);
    if (!metric) continue;
    if (std::ranges::find(metrics_, metric->name, &Metric::name) != metrics_.end())
      scoped.inner.error(m.position, m.where, fmt::format("two metrics are called '{}'", metric->name));
    looks_back_.push_back(reference_frames_back(metric->graph));
    metrics_.push_back(std::move(*metric));
  }
  return lab.diagnostics.errors() == before;
}

bool Trial::judges(std::size_t metric, std::int64_t frame) const {
  const auto& frames = sequence_.frames;
  const auto at = std::ranges::find(frames, frame) - frames.begin();
  for (auto i = at; i >= 0 && i >= at - looks_back_[metric]; --i)
    if (!reference_frames_.contains(frames[std::size_t(i)])) return false;
  return true;
}

bool Trial::load_variants(bool maps, Laboratory& lab) {
  const std::size_t before = lab.diagnostics.errors();
  for (const auto& variant : study_->variants) {
    auto graph = judged(variant, maps, lab);
    if (graph) variants_.push_back(std::move(*graph));
    // What is wrong with the graph itself would be said again of each variant.
    if (!graph && &variant == &study_->variants.front()) return false;
  }
  return lab.diagnostics.errors() == before;
}

std::optional<JudgedGraph> Trial::judged(const StudyVariant& variant, bool maps, Laboratory& lab) const {
  Scoped scoped(lab.diagnostics, variant.position, variant.where, fmt::format("of the variant '{}'", variant.name));
  GraphRequest request = request_of(variant, lab);
  request.roles = roles_;
  auto graph = load_graph(request, lab.registry, scoped.inner);
  if (!graph) return std::nullopt;
  const auto error = [&](std::string text, std::vector<std::string> notes = {}) {
    scoped.inner.error(variant.position, variant.where, std::move(text), std::move(notes));
    return std::nullopt;
  };
  const auto names = names_of(graph->outputs);
  auto judged = graph->outputs.begin();
  if (!study_->output.empty())
    judged = std::ranges::find(graph->outputs, study_->output, &GraphOutput::name);
  else
    judged = std::ranges::find(graph->outputs, int(QUELL_RADIANCE), &GraphOutput::type);
  // Baselines come from elsewhere, where an output may have another name.
  if (judged == graph->outputs.end() && variant.baseline)
    judged = std::ranges::find(graph->outputs, int(QUELL_RADIANCE), &GraphOutput::type);
  if (judged == graph->outputs.end())
    return study_->output.empty()
               ? error("the graph has no output of type radiance to be judged", {possibilities("it has", "", names)})
               : error(fmt::format("the graph has no output '{}'", study_->output),
                       {possibilities("it has", study_->output, names)});
  if (judged->type != QUELL_RADIANCE)
    return error(fmt::format("output '{}' is {}, but metrics judge radiance", judged->name, type_name(judged->type)));
  JudgedGraph out{*graph, *graph, int(judged - graph->outputs.begin()), {}};
  std::vector<std::string> wanted = {"value", "pixels"};
  if (maps) wanted.push_back("map");
  for (const auto& metric : metrics_) {
    const auto first = out.graph.outputs.size();
    attach_metric(out.graph, out.judged, metric, metric.name, wanted);
    JudgedGraph::Outputs outputs{-1, -1, -1};
    for (auto i = first; i < out.graph.outputs.size(); ++i) {
      const auto& name = out.graph.outputs[i].name;
      (name.ends_with(".value") ? outputs.value : name.ends_with(".pixels") ? outputs.pixels : outputs.map) = int(i);
    }
    out.metrics.push_back(outputs);
  }
  return out;
}

Instance Trial::with_seed(const std::optional<StudySeeds>& seeds, std::size_t seed) const {
  Instance node = *source_;
  if (seeds) node.set_int(node.type().find_param(seeds->parameter), seeds->values[seed]);
  return node;
}

std::vector<std::string> Trial::all_roles() const {
  std::set<std::string> roles;
  if (roles_.contains("color")) roles.insert("color");
  for (const auto& variant : variants_)
    for (const auto& input : variant.graph.inputs) roles.insert(input.name);
  return {roles.begin(), roles.end()};
}

void Trial::check_frames(Laboratory& lab) const {
  const auto source = open(all_roles(), study_->seeds, 0, lab);
  if (!source || !lab.diagnostics.ok()) return;
  // A frame that all is there of.
  const auto frame = reference_frames_.empty() ? source->frames().front() : *reference_frames_.begin();
  for (const auto& variant : variants_) {
    const auto roles = names_of(variant.graph.inputs);
    const auto shapes = source->shapes(frame, roles);
    try {
      const Plan plan(variant.graph, shapes, {false, false});
    } catch (const Error& e) {
      std::vector<std::string> sizes;
      for (std::size_t i = 0; i < roles.size(); ++i)
        if (roles[i] == "color" || is_reference(roles[i]))
          sizes.push_back(fmt::format("{} is {}x{}", roles[i], shapes[i].width, shapes[i].height));
      throw Error(Exit::input,
                  fmt::format("the images of the sequence '{}' do not fit each other: in frame {} {}\n  {}",
                              declared_->name, frame, fmt::join(sizes, ", "), e.what()));
    }
  }
}

std::unique_ptr<FileSequence> Trial::open_files(const std::vector<std::string>& roles, Laboratory& lab) const {
  try {
    return open_sequence(sequence_, roles, Missing::error, lab.diagnostics);
  } catch (const MissingFrames& e) {
    throw Error(e.exit(), fmt::format("{}\n  of the sequence '{}'{}", e.what(), declared_->name,
                                      e.others() ? "; \"frames\" beside its \"path\" picks others" : ""));
  }
}

std::unique_ptr<FrameSource> Trial::open(const std::vector<std::string>& roles, const std::optional<StudySeeds>& seeds,
                                         std::size_t seed, Laboratory& lab) const {
  const auto made = [&](const Instance& node) {
    return std::make_unique<NodeSource>(node, sequence_.frames, sequence_.cuts, lab.threads, lab.cancel);
  };
  std::vector<JoinedSource::Part> parts;
  const auto add = [&](const char* what, std::unique_ptr<FrameSource> source) -> JoinedSource::Part& {
    return parts.emplace_back(
        JoinedSource::Part{fmt::format("{} of '{}'", what, declared_->name), std::move(source), {}, false, {}});
  };
  std::vector<std::string> own;
  std::ranges::copy_if(roles, std::back_inserter(own), [](const auto& role) { return !is_reference(role); });
  auto input = source_ ? made(with_seed(seeds, seed)) : nullptr;
  auto files = source_ ? nullptr : open_files(own, lab);
  if (!input && !files) return nullptr;
  auto& first = source_ ? add("the frames", std::move(input)) : add("the frames", std::move(files));
  for (const auto& role : own) first.roles[role] = role;
  for (const auto& [role, node] : reference_nodes_)
    add("the reference", keep_reference(made(node), node, lab.references)).roles[role] = "color";
  if (!sequence_.references.empty() && !reference_frames_.empty()) {
    std::vector<std::string> halves;
    for (const auto& half : sequence_.references) halves.push_back(half.role);
    auto references = open_files(halves, lab);
    if (!references) return nullptr;
    auto& part = add("the reference", std::move(references));
    for (const auto& half : halves) part.roles[half] = half;
    part.sparse.assign(reference_frames_.begin(), reference_frames_.end());
  }
  auto source = with_mean_of_halves(std::make_unique<JoinedSource>(std::move(parts)));
  // Graphs repair their inputs and say so; what judges them must not be made up.
  std::vector<std::string> judging;
  for (const auto& [role, type] : source->roles())
    if (is_reference(role)) judging.push_back(role);
  source->refuse_non_finite(judging);
  return source;
}

std::string Trial::identity(const std::optional<StudySeeds>& seeds, std::size_t seed) const {
  std::string text = fmt::format("frames {}\ncuts", frame_range_text(sequence_.frames));
  for (const auto cut : sequence_.cuts) text += fmt::format(" {}", cut);
  text += "\n";
  if (source_) text += "source " + node_identity(with_seed(seeds, seed));
  for (const auto& [role, node] : reference_nodes_) text += fmt::format("{} {}", role, node_identity(node));
  for (const auto* list : {&sequence_.inputs, &sequence_.references})
    for (const auto& input : *list) text += "files " + describe(input, sequence_.frames);
  return text;
}

}  // namespace quell
