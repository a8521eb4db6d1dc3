// Every image is an output of a graph over a sequence: of a variant, of a variant with its metrics, or of no node.
#include "core/lab/study_images.h"

#include "core/graph/narrow.h"
#include "core/lab/edits.h"
#include "core/sequence/image_writer.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <utility>

namespace quell {

namespace fs = std::filesystem;

namespace {

std::string frame_text(std::int64_t frame) { return fmt::format("{:04}", frame); }

// Gives a role as it is.
Graph only(const std::string& role) {
  Graph graph;
  graph.name = role;
  graph.inputs.push_back({role, QUELL_RADIANCE, false});
  graph.outputs.push_back({"color", {{Source::kInput, 0}, 0, {}}, QUELL_RADIANCE, false});
  return graph;
}

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

std::vector<ResultImage> StudyImages::list(const Study& study, const Trial& trial, std::size_t sequence,
                                           const fs::path& results) const {
  const auto relative = [&](const std::string& file) { return fs::path(file).lexically_relative(results); };
  std::vector<ResultImage> all;
  for (const auto frame : trial.sequence().frames) {
    if (!frames.contains(frame)) continue;
    if (trial.roles().contains("color")) all.push_back({"input", {}, sequence, frame, {}, relative(input(frame))});
    if (trial.reference_frames().contains(frame))
      all.push_back({"reference", {}, sequence, frame, {}, relative(reference(frame))});
    for (std::size_t v = 0; v < study.variants.size(); ++v) {
      const auto& name = study.variants[v].name;
      all.push_back({"output", v, sequence, frame, {}, relative(output(name, frame))});
      for (std::size_t m = 0; m < trial.metrics().size(); ++m)
        if (trial.variants()[v].metrics[m].map >= 0 && trial.judges(m, frame))
          all.push_back({"map", v, sequence, frame, m, relative(map(trial.metrics()[m].name, name, frame))});
    }
  }
  return all;
}

StudyImageWriter::StudyImageWriter(const Study& study, const Trial& trial, const StudyImages& images,
                                   std::vector<ShownOutput> shown, const Made& made)
    : study_(&study), trial_(&trial), images_(&images) {
  using Kind = ShownOutput::Kind;
  Study here = study;  // whose first sequence is this one
  here.sequences = {trial.declared()};
  for (const auto& s : shown) {
    const bool of_variant = s.kind == Kind::output || s.kind == Kind::map;
    const auto& judged = trial.variants()[s.variant];
    const Graph graph = s.kind == Kind::output ? judged.plain
                        : s.kind == Kind::map ? narrowed(judged.graph, std::size_t(judged.metrics[s.metric].map), "map")
                        : s.kind == Kind::input ? only("color")
                                                : only(std::string(kReference));
    Image image{s, Provenance(graph, made.source, made.log, made.run), made.texts};
    const auto& output = graph.outputs[std::size_t(s.kind == Kind::output ? judged.judged : 0)];
    image.texts["quell:output"] = output_text(graph, output, WriteOptions{});
    if (of_variant) {
      image.texts["quell:variant"] = study.variants[s.variant].name;
      image.texts["quell:run"] = run_command(here, study.variants[s.variant]);
    }
    all_.push_back(std::move(image));
  }
}

void StudyImageWriter::history_begins(std::int64_t frame) {
  for (auto& image : all_) image.provenance.history_begins(frame);
}

std::string StudyImageWriter::path_of(const ShownOutput& s, std::int64_t frame) const {
  switch (s.kind) {
    case ShownOutput::Kind::output:
      return images_->output(study_->variants[s.variant].name, frame);
    case ShownOutput::Kind::map:
      return images_->map(trial_->metrics()[s.metric].name, study_->variants[s.variant].name, frame);
    case ShownOutput::Kind::input:
      return images_->input(frame);
    case ShownOutput::Kind::reference:
      break;
  }
  return images_->reference(frame);
}

void StudyImageWriter::write(std::int64_t frame, std::span<const quell_image> outputs) {
  for (auto& image : all_) {
    // Of every frame, for the history of those behind it.
    auto made = image.provenance.texts(frame);
    if (outputs.empty() || !images_->frames.contains(frame)) continue;
    const auto kind = image.shown.kind;
    if (kind == ShownOutput::Kind::reference && !trial_->reference_frames().contains(frame)) continue;
    if (kind == ShownOutput::Kind::map && !trial_->judges(image.shown.metric, frame)) continue;
    WriteOptions options;
    options.metadata = std::move(made);
    options.metadata.insert(image.texts.begin(), image.texts.end());
    write_image(path_of(image.shown, frame), outputs[image.shown.output],
                kind == ShownOutput::Kind::map ? QUELL_SCALAR : QUELL_RADIANCE, options);
  }
}

}  // namespace quell
