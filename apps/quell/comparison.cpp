// Joins pictures, reference and metrics into one graph, runs it and collects the numbers.
#include "apps/quell/comparison.h"

#include "apps/quell/error_maps.h"
#include "apps/quell/judges.h"
#include "apps/quell/options.h"
#include "apps/quell/previews.h"

#include "core/graph/narrow.h"
#include "core/graph/write.h"
#include "core/lab/halves.h"
#include "core/lab/merge.h"
#include "core/lab/metric.h"
#include "core/report/shell.h"
#include "core/run/provenance.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace quell {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPicture = "picture_";  // and its number: the role of a picture

// Where an output of the merged graph belongs.
struct Place {
  enum class Kind { value, pixels, map };
  std::size_t picture, metric;
  Kind kind;
  std::size_t map = 0;  // among the maps
};

class Comparison {
 public:
  Comparison(Commander& commander, const ComparisonRequest& request)
      : commander_(commander),
        request_(request),
        metrics_(wanted_metrics(request.metrics, request.thresholds)),
        maps_(request.maps, request.pictures) {}

  std::optional<Results> run(const std::function<void(const Progress&)>& progress) {
    check_names();
    if (!open()) return std::nullopt;
    judges_ = load_judges(commander_, metrics_, source_->roles());
    if (!commander_.diagnostics().ok()) return std::nullopt;
    build();
    check_written();
    RunOptions options;
    options.threads = request_.threads;
    options.cancel = request_.cancel;
    options.progress = progress;
    const FileLog log(*source_);
    maps_.begin(*source_, log, {command_line(), simd_in_use(), "error", {}, graphs()});
    Sink sink(*this);
    describe();
    try {
      run_graph(graph_, *source_, sink, options);
    } catch (const Error& e) {
      if (at_ == 0)
        for (const auto& picture : request_.pictures) explain(e, picture.name + "/", judges_);
      throw;
    }
    return std::move(results_);
  }

 private:
  class Sink : public FrameSink {
   public:
    explicit Sink(Comparison& all) : all_(all) {}
    void history_begins(std::int64_t frame) override { all_.maps_.history_begins(frame); }
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
    const OpenPictures how{request_.frames,  request_.root,   request_.references,
                           request_.threads, request_.cancel, read_};
    std::vector<JoinedSource::Part> parts;
    for (std::size_t i = 0; i < request_.pictures.size(); ++i) {
      const auto& p = request_.pictures[i];
      open_pictures(commander_, p.text, p.name, role_of(i), how, parts);
    }
    if (!request_.reference.empty()) open_reference(commander_, request_.reference, "the reference", how, parts);
    auto features = request_.sequence;
    if (features.empty() && is_sequence(request_.reference)) features = request_.reference;
    if (!features.empty())
      open_features(commander_, features, "the sequence", roles_of(commander_, metrics_), how, parts);
    if (!commander_.diagnostics().ok()) return false;
    std::vector<std::string> still;
    for (std::size_t i = 0; i < request_.pictures.size(); ++i)
      if (parts[i].still) still.push_back(request_.pictures[i].text);
    auto joined = std::make_unique<JoinedSource>(std::move(parts));
    joined_ = joined.get();
    source_ = with_mean_of_halves(std::move(joined));
    if (const auto frames = source_->frames().size(); frames > 1)
      for (const auto& picture : still)
        request_.warn(
            fmt::format("'{}' is one file and stands for all {} frames; --frames picks one", picture, frames));
    check_sizes();
    // What was replaced on the way in would be judged as if it had been there.
    std::vector<std::string> judged;
    for (const auto& [role, type] : source_->roles())
      if (type == QUELL_RADIANCE) judged.push_back(role);
    source_->refuse_non_finite(judged);
    return true;
  }

  // Before anything is made that takes time.
  void check_written() const {
    for (const auto& file : request_.written)
      if (read_.contains(plain_path(file)))
        throw Error(Exit::usage, fmt::format("{} is read, and results would be written over it", file));
    for (const auto frame : source_->frames())
      for (const auto& file : maps_.files(frame))
        if (read_.contains(file))
          throw Error(Exit::usage, fmt::format("{} is read, and an error map would be written over it", file));
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

  const fs::path& graphs() const { return commander_.locations().graphs; }

  // ---- The graph ----

  void build() {
    for (std::size_t i = 0; i < request_.pictures.size(); ++i) {
      auto& graph = graphs_.emplace_back();
      graph.name = request_.pictures[i].name;
      graph.inputs = {{role_of(i), QUELL_RADIANCE, false}};
      graph.outputs = {{"color", {{Source::kInput, 0}, 0, {}}, QUELL_RADIANCE, false}};
      std::vector<std::string> wanted = {"value", "pixels"};
      if (maps_.wanted()) wanted.push_back("map");
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
        auto& place = places_.emplace_back(Place{i, std::size_t(judge - judges_.begin()), Place::Kind::value});
        if (kind == "pixels") place.kind = Place::Kind::pixels;
        if (kind == "map")
          place.kind = Place::Kind::map, place.map = maps_.add(i, judge->metric.name, narrowed(graphs_[i], o, "map"));
        // As a graph file can say it.
        output.name[dot] = '_', output.tap = false;
      }
    if (maps_.wanted()) add_previews(graph_, {.wanted = true, .graph = {}, .set = {}}, commander_);
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
    maps_.begin_frame(frame);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const auto& output = graph_.outputs[i];
      const Place place = places_[output.shows < 0 ? i : std::size_t(output.shows)];
      const auto& judge = judges_[place.metric];
      if (in_a_row_ <= std::min(judge.back, int(at_))) continue;
      auto& number = results_.numbers[0][0][place.picture][at_][place.metric];
      const float found = outputs[i].plane[0][0];
      if (place.kind == Place::Kind::map)
        maps_.write(place.map, frame, outputs[i], output);
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

  Commander& commander_;
  const ComparisonRequest& request_;
  std::vector<WantedMetric> metrics_;
  JoinedSource* joined_ = nullptr;
  std::unique_ptr<FrameSource> source_;
  std::set<std::string> read_;  // plain paths of files
  std::vector<Judge> judges_;
  std::vector<Graph> graphs_;  // by picture
  Graph graph_;                // merged of them
  ErrorMaps maps_;
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
