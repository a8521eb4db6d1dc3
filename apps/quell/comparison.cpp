// Joins pictures, reference and metrics into one graph, runs it and collects the numbers.
#include "apps/quell/comparison.h"

#include "apps/quell/options.h"
#include "apps/quell/previews.h"

#include "core/graph/narrow.h"
#include "core/graph/write.h"
#include "core/lab/halves.h"
#include "core/lab/merge.h"
#include "core/lab/metric.h"
#include "core/report/shell.h"
#include "core/report/suggest.h"
#include "core/run/provenance.h"
#include "core/sequence/frame_pattern.h"
#include "core/sequence/image_writer.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace quell {

namespace {

constexpr const char* kPicture = "picture_";  // and its number: the role of a picture
constexpr const char* kUsual[] = {"psnr_unbiased", "relmse", "psnr_pu", "ssim", "flip", "flicker"};

// A metric, and frames before the current one whose references it needs; -1: it needs none.
struct Judge {
  Metric metric;
  int back;

  explicit Judge(Metric m) : metric(std::move(m)), back(reference_frames_back(metric.graph)) {}
};

// Where an output of the merged graph belongs.
struct Place {
  enum class Kind { value, pixels, map };
  std::size_t picture, metric;
  Kind kind;
};

// An error image: the graph that makes it and nothing else, and what the current frame's says of how it was made.
struct Map {
  std::size_t picture, metric;
  Graph graph;
  std::optional<Provenance> provenance = {};
  Texts texts = {};
};

class Comparison {
 public:
  Comparison(Commander& commander, const ComparisonRequest& request) : commander_(commander), request_(request) {}

  std::optional<Results> run(const std::function<void(const Progress&)>& progress) {
    check_names();
    if (!open() || !load_metrics()) return std::nullopt;
    build();
    RunOptions options;
    options.threads = request_.threads;
    options.cancel = request_.cancel;
    options.progress = progress;
    const FileLog log(*source_);
    for (auto& map : maps_)
      map.provenance.emplace(map.graph, *source_, log,
                             Provenance::Run{command_line(), simd_in_use(), "error", {}, graphs()});
    Sink sink(*this);
    describe();
    run_graph(graph_, *source_, sink, options);
    return std::move(results_);
  }

 private:
  class Sink : public FrameSink {
   public:
    explicit Sink(Comparison& all) : all_(all) {}
    void history_begins(std::int64_t frame) override {
      for (auto& map : all_.maps_) map.provenance->history_begins(frame);
    }
    void write(std::int64_t frame, std::span<const quell_image> outputs) override { all_.collect(frame, outputs); }

   private:
    Comparison& all_;
  };

  // ---- What is read ----

  void check_names() const {
    std::set<std::string> names;
    for (const auto& p : request_.pictures)
      if (!names.insert(p.name).second)
        throw Error(Exit::usage, fmt::format("two of the pictures are called '{}'; NAME=… names them apart", p.name));
  }

  bool open() {
    const OpenPictures how{request_.frames, request_.root, request_.references, request_.threads, request_.cancel};
    std::vector<JoinedSource::Part> parts;
    for (std::size_t i = 0; i < request_.pictures.size(); ++i) {
      const auto& p = request_.pictures[i];
      open_pictures(commander_, p.text, p.name, role_of(i), how, parts);
    }
    if (!request_.reference.empty()) open_reference(commander_, request_.reference, "the reference", how, parts);
    auto features = request_.sequence;
    if (features.empty() && is_sequence(request_.reference)) features = request_.reference;
    if (!features.empty()) open_features(commander_, features, "the sequence", wanted_roles(), how, parts);
    if (!commander_.diagnostics().ok()) return false;
    auto joined = std::make_unique<JoinedSource>(std::move(parts));
    joined_ = joined.get();
    source_ = with_mean_of_halves(std::move(joined));
    check_sizes();
    // What was replaced on the way in would be judged as if it had been there.
    std::vector<std::string> judged;
    for (const auto& [role, type] : source_->roles())
      if (type == QUELL_RADIANCE) judged.push_back(role);
    source_->refuse_non_finite(judged);
    return true;
  }

  // A graph would say so too, but of its nodes.
  void check_sizes() {
    std::vector<std::string> roles = {role_of(0)}, names = {request_.pictures[0].name};
    for (std::size_t i = 1; i < request_.pictures.size(); ++i)
      roles.push_back(role_of(i)), names.push_back(request_.pictures[i].name);
    for (const bool references : {true, false})
      for (const auto& [role, type] : source_->roles())
        if (is_reference(role) == references && !role.starts_with(kPicture) && type != QUELL_CAMERA &&
            type != QUELL_TRANSFORMS)
          roles.push_back(role), names.push_back(references ? "the reference" : "the sequence's " + role);
    // Later frames of another size end the run, which says it less well; to look at all of them now would read each
    // file's header twice.
    const auto frame = source_->frames().front();
    const auto shapes = source_->shapes(frame, roles);
    for (std::size_t i = 1; i < shapes.size(); ++i)
      if (shapes[i].width != shapes[0].width || shapes[i].height != shapes[0].height)
        throw Error(Exit::input, fmt::format("frame {}: {} is {}x{}, but {} is {}x{}", frame, names[i], shapes[i].width,
                                             shapes[i].height, names[0], shapes[0].width, shapes[0].height));
  }

  static std::string role_of(std::size_t picture) { return fmt::format("{}{}", kPicture, picture); }

  // All that the metrics could read of a sequence.
  std::set<std::string> wanted_roles() {
    std::set<std::string> roles;
    for (const auto& name : metric_names()) {
      Diagnostics quiet;
      if (const auto metric = load_metric(name, graphs(), commander_.registry(), quiet))
        for (const auto& input : metric->graph.inputs)
          if (input.name != kJudged) roles.insert(input.name);
    }
    return roles;
  }

  // ---- What judges ----

  const std::filesystem::path& graphs() const { return commander_.locations().graphs; }

  std::vector<std::string> metric_names() const {
    auto names = request_.metrics;
    if (names.empty()) names.assign(std::begin(kUsual), std::end(kUsual));
    for (const auto& t : request_.thresholds)
      if (std::ranges::find(names, t.metric) == names.end()) names.push_back(t.metric);
    return names;
  }

  bool load_metrics() {
    auto roles = source_->roles();
    roles.emplace(kJudged, QUELL_RADIANCE);
    const bool usual = request_.metrics.empty();
    for (const auto& name : metric_names()) {
      Diagnostics quiet;
      const auto any = load_metric(name, graphs(), commander_.registry(), quiet);
      const bool served = !any || std::ranges::all_of(any->graph.inputs, [&](const GraphInput& i) {
        return i.optional || roles.contains(i.name);
      });
      const bool asked = !usual || std::ranges::find(kUsual, name) == std::end(kUsual) ||
                         std::ranges::find(request_.thresholds, name, &Threshold::metric) != request_.thresholds.end();
      if (!served && !asked) continue;
      if (!served) {
        explain(*any, roles);
        continue;
      }
      if (auto metric = load_metric(name, graphs(), commander_.registry(), commander_.diagnostics(), roles))
        judges_.emplace_back(std::move(*metric));
    }
    if (judges_.empty() && commander_.diagnostics().ok())
      throw Error(Exit::usage, "there is nothing to judge by: --reference or --sequence is missing");
    return commander_.diagnostics().ok();
  }

  void explain(const Metric& metric, const std::map<std::string, int>& roles) {
    for (const auto& input : metric.graph.inputs) {
      if (input.optional || roles.contains(input.name)) continue;
      std::string why = "--sequence names what has it";
      if (is_reference(input.name))
        why = input.name == "reference"
                  ? "--reference names it"
                  : R"(it is one of two halves, as a sequence has with "reference": {"A": …, "B": …})";
      commander_.diagnostics().error(
          {}, "", fmt::format("the metric '{}' reads '{}', which is not there", metric.name, input.name), {why});
    }
  }

  // ---- The graph ----

  void build() {
    for (std::size_t i = 0; i < request_.pictures.size(); ++i) {
      auto& graph = graphs_.emplace_back();
      graph.name = request_.pictures[i].name;
      graph.inputs = {{role_of(i), QUELL_RADIANCE, false}};
      graph.outputs = {{"color", {{Source::kInput, 0}, 0, {}}, QUELL_RADIANCE, false}};
      std::vector<std::string> wanted = {"value", "pixels"};
      if (!request_.maps.empty()) wanted.push_back("map");
      for (const auto& judge : judges_) attach_metric(graph, 0, judge.metric, judge.metric.name, wanted);
      graph.outputs.erase(graph.outputs.begin());
    }
    std::vector<MergePart> parts;
    for (const auto& graph : graphs_) parts.push_back({graph.name, &graph});
    graph_ = merge(parts).graph;
    for (std::size_t i = 0; i < graphs_.size(); ++i)
      for (std::size_t o = 0; o < graphs_[i].outputs.size(); ++o) {
        auto& output = graphs_[i].outputs[o];
        const auto dot = output.name.rfind('.');
        const auto judge = std::ranges::find_if(
            judges_, [&](const Judge& j) { return j.metric.name == std::string_view(output.name).substr(0, dot); });
        const auto kind = output.name.substr(dot + 1);
        places_.push_back({i, std::size_t(judge - judges_.begin()),
                           kind == "value"    ? Place::Kind::value
                           : kind == "pixels" ? Place::Kind::pixels
                                              : Place::Kind::map});
        if (kind == "map") maps_.push_back({i, places_.back().metric, narrowed(graphs_[i], o, "map")});
        // As a graph file can say it.
        output.name[dot] = '_', output.tap = false;
      }
    if (!request_.maps.empty()) add_previews(graph_, {.wanted = true, .graph = {}, .set = {}}, commander_);
  }

  // ---- What is found ----

  void describe() {
    Results& r = results_;
    r.name = "comparison";
    r.version = QUELL_VERSION;
    r.simd = simd_in_use();
    r.warm_up = request_.warm_up;
    for (const auto& j : judges_)
      r.metrics.push_back(
          {j.metric.name, j.metric.title, j.metric.key.unit, j.metric.key.higher_is_better, j.metric.key.perfect});
    for (std::size_t i = 0; i < graphs_.size(); ++i) {
      const auto& p = request_.pictures[i];
      ResultVariant v;
      v.name = p.name, v.about = p.text, v.edits = "{}";
      v.command = shell_text(command_line()), v.fingerprint = fingerprint(graphs_[i]);
      v.graph = write_graph(graphs_[i], graphs()).text;
      r.variants.push_back(std::move(v));
    }
    const auto size = source_->shapes(source_->frames().front(), std::vector<std::string>{role_of(0)}).front();
    r.sequences.push_back({"pictures", request_.reference, size.width, size.height, source_->frames()});
    r.numbers.assign(1, {std::vector<std::vector<FrameNumbers>>(
                            r.variants.size(),
                            std::vector<FrameNumbers>(source_->frames().size(), FrameNumbers(r.metrics.size())))});
  }

  bool has_reference(std::int64_t frame) const {
    for (const auto& [role, type] : joined_->roles())
      if (is_reference(role) && !joined_->has(frame, role)) return false;
    return true;
  }

  void collect(std::int64_t frame, std::span<const quell_image> outputs) {
    in_a_row_ = has_reference(frame) ? in_a_row_ + 1 : 0;
    for (auto& map : maps_) map.texts = map.provenance->texts(frame);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const auto& output = graph_.outputs[i];
      const Place place = places_[output.shows < 0 ? i : std::size_t(output.shows)];
      const auto& judge = judges_[place.metric];
      if (in_a_row_ <= std::min(judge.back, int(at_))) continue;
      auto& number = results_.numbers[0][0][place.picture][at_][place.metric];
      const float found = outputs[i].plane[0][0];
      if (place.kind == Place::Kind::map)
        write_map(place, frame, outputs[i], output);
      else if (place.kind == Place::Kind::value)
        number = found;
      else if (found == 0)
        empty_.push_back(&number);
    }
    // A frame without pixels has no number, whichever of the two came first.
    for (auto* number : empty_) number->reset();
    empty_.clear();
    ++at_;
  }

  void write_map(const Place& place, std::int64_t frame, const quell_image& image, const GraphOutput& output) const {
    std::string name = request_.pictures[place.picture].name;
    std::ranges::replace_if(
        name, [](char c) { return c == '/' || c == '#' || c == '@' || c == '%'; }, '_');
    const std::string file = fmt::format("{}/{}.{}.####.{}", request_.maps, name, judges_[place.metric].metric.name,
                                         output.shows < 0 ? "exr" : "png");
    WriteOptions options;
    const auto& map = *std::ranges::find_if(
        maps_, [&](const Map& m) { return m.picture == place.picture && m.metric == place.metric; });
    options.metadata = map.texts;
    GraphOutput written = map.graph.outputs[0];
    written.type = output.type;
    if (output.shows >= 0) written.shows = 0;
    options.metadata["quell:output"] = output_text(map.graph, written, options);
    write_image(FramePattern(file).path(frame), image, output.type, options);
  }

  Commander& commander_;
  const ComparisonRequest& request_;
  JoinedSource* joined_ = nullptr;
  std::unique_ptr<FrameSource> source_;
  std::vector<Judge> judges_;
  std::vector<Graph> graphs_;  // by picture
  Graph graph_;                // merged of them
  std::vector<Map> maps_;
  std::vector<Place> places_;  // of the outputs that are no previews
  Results results_;
  std::vector<std::optional<double>*> empty_;
  std::size_t at_ = 0;  // of the frame among all
  int in_a_row_ = 0;    // frames with a reference, up to this one
};

}  // namespace

std::optional<Results> run_comparison(Commander& commander, const ComparisonRequest& request,
                                      const std::function<void(const Progress&)>& progress) {
  return Comparison(commander, request).run(progress);
}

}  // namespace quell
