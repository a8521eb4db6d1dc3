// A run's outputs to files.
#include "apps/quell/file_sink.h"

#include "core/graph/write.h"
#include "core/report/error.h"
#include "core/report/suggest.h"
#include "core/sequence/temporary_file.h"

#include <quell/types.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

namespace quell {

namespace fs = std::filesystem;

namespace {

std::string beside(const std::string& first, const std::string& output) {
  const fs::path path(first);
  return (path.parent_path() / (output + ".####" + path.extension().string())).string();
}

}  // namespace

FileSink::FileSink(const Graph& graph, const Sequence& sequence, std::span<const std::int64_t> frames,
                   const std::vector<std::string>& wanted, WriteOptions options, Provenance& provenance)
    : options_(std::move(options)), provenance_(provenance) {
  for (const auto& output : graph.outputs) {
    output_texts_.push_back(output_text(graph, output, options_));
    if (output.shows < 0) types_.push_back(output.type), names_.push_back(output.name);
  }
  const auto texts = choose(wanted);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    patterns_.emplace_back(texts[i]);
    if (types_[i] == QUELL_VALUE) {
      values_.push_back({names_[i], {}});
      continue;
    }
    if (frames.size() > 1 && !patterns_.back().numbered())
      throw Error(Exit::usage,
                  fmt::format("-o {}: every frame would go to this one file; put #### where the frame number belongs",
                              texts[i]));
    check_writing(texts[i], types_[i]);
  }
  for (const auto& output : graph.outputs) {
    if (output.shows < 0) continue;
    const fs::path image(texts[std::size_t(output.shows)]);
    // A PNG is its own preview.
    previews_.emplace_back(image.extension() == ".png" ? "" : fs::path(image).replace_extension(".png").string());
    shown_.push_back(output.shows);
  }
  check_files(sequence, frames);
}

std::vector<std::string> FileSink::choose(const std::vector<std::string>& wanted) const {
  const auto& names = names_;
  std::vector<std::string> texts(names.size());
  const auto first = std::size_t(std::ranges::find_if(types_, [](int t) { return t != QUELL_VALUE; }) - types_.begin());
  if (names.empty()) throw Error(Exit::usage, "the graph has no outputs, so there is nothing to write");
  for (const auto& w : wanted) {
    // A '=' behind a slash belongs to a folder's or file's name.
    const auto equals = w.find('=');
    const bool named = equals < w.find('/');
    std::size_t index = first;
    if (named) {
      const auto name = w.substr(0, equals);
      const auto it = std::ranges::find(names, name);
      if (it == names.end())
        throw Error(Exit::usage, fmt::format("-o {}: the graph has no output '{}'\n  {}", w, name,
                                             possibilities("it has", name, names)));
      index = std::size_t(it - names.begin());
    }
    if (index == names.size() || types_[index] == QUELL_VALUE)
      throw Error(Exit::usage,
                  fmt::format("-o {}: {} a number a frame, which no file is written of: it is printed, and "
                              "--report writes it",
                              w, named ? fmt::format("output '{}' is", names[index]) : "each output is"));
    if (!texts[index].empty())
      throw Error(Exit::usage, fmt::format("-o {}: output '{}' already goes to {}; write NAME=PATTERN for another", w,
                                           names[index], texts[index]));
    texts[index] = named ? w.substr(equals + 1) : w;
    if (texts[index].empty())
      throw Error(Exit::usage, fmt::format("-o '{}': names no file; as in -o 'out/color.####.exr'", w));
  }
  for (std::size_t i = first; i < texts.size(); ++i)
    if (texts[i].empty() && types_[i] != QUELL_VALUE)
      texts[i] = i == first ? fmt::format("out/{}.####.exr", names[i]) : beside(texts[first], names[i]);
  return texts;
}

void FileSink::check_files(const Sequence& sequence, std::span<const std::int64_t> frames) const {
  for (const auto* list : {&patterns_, &previews_})
    for (const auto& pattern : *list)
      if (!pattern.text().empty()) check_writable(pattern.path(frames.front()));
  const auto absolute = [](const std::string& path) { return fs::absolute(path).lexically_normal().string(); };
  for (const std::int64_t frame : frames) {
    std::map<std::string, std::string> taken;  // file: what it is
    for (const auto& list : {&sequence.inputs, &sequence.references})
      for (const auto& input : *list)
        taken.emplace(absolute(input.file.path(frame)), fmt::format("the sequence's '{}'", input.role));
    for (const auto* list : {&patterns_, &previews_})
      for (std::size_t i = 0; i < list->size(); ++i) {
        const auto& pattern = (*list)[i];
        if (pattern.text().empty()) continue;
        const auto what = list == &previews_ ? fmt::format("the preview of '{}'", names_[std::size_t(shown_[i])])
                                             : fmt::format("output '{}'", names_[i]);
        const auto [other, fresh] = taken.emplace(absolute(pattern.path(frame)), what);
        if (!fresh)
          throw Error(Exit::usage, fmt::format("{} and {} would both be {}; choose another with -o", other->second,
                                               what, pattern.text()));
      }
  }
}

void FileSink::write(std::int64_t frame, std::span<const quell_image> outputs) {
  options_.metadata = provenance_.texts(frame);
  const auto write_one = [&](const FramePattern& pattern, std::size_t output, int type) {
    options_.metadata["quell:output"] = output_texts_[output];
    write_image(pattern.path(frame), outputs[output], type, options_);
  };
  auto value = values_.begin();
  for (std::size_t i = 0; i < patterns_.size(); ++i)
    if (types_[i] == QUELL_VALUE)
      (value++)->frames.emplace_back(frame, outputs[i].plane[0][0]);
    else
      write_one(patterns_[i], i, types_[i]);
  for (std::size_t i = 0; i < previews_.size(); ++i)
    if (!previews_[i].text().empty()) write_one(previews_[i], patterns_.size() + i, QUELL_DISPLAY);
  written_.push_back(frame);
}

}  // namespace quell
