// A run's outputs to files.
#include "apps/quell/file_sink.h"

#include "core/report/error.h"
#include "core/report/suggest.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace quell {

namespace fs = std::filesystem;

namespace {

std::string beside(const std::string& first, const std::string& output) {
  const fs::path path(first);
  return (path.parent_path() / (output + ".####" + path.extension().string())).string();
}

bool shows(int type) {
  return type == QUELL_RADIANCE || type == QUELL_ALBEDO || type == QUELL_DISPLAY || type == QUELL_NORMAL;
}

}  // namespace

FileSink::FileSink(const Graph& graph, const std::vector<std::string>& wanted, bool several_frames, bool preview,
                   WriteOptions options)
    : options_(std::move(options)) {
  std::vector<std::string> names, texts(graph.outputs.size());
  for (const auto& output : graph.outputs) names.push_back(output.name), types_.push_back(output.type);
  if (names.empty()) throw Error(Exit::usage, "the graph has no outputs, so there is nothing to write");
  for (const auto& w : wanted) {
    const auto equals = w.find('=');
    std::size_t index = 0;
    if (equals != w.npos) {
      const auto name = w.substr(0, equals);
      const auto it = std::ranges::find(names, name);
      if (it == names.end())
        throw Error(Exit::usage, fmt::format("-o {}: the graph has no output '{}'\n  {}", w, name,
                                             possibilities("it has", name, names)));
      index = std::size_t(it - names.begin());
    }
    if (!texts[index].empty())
      throw Error(Exit::usage, fmt::format("-o {}: output '{}' already goes to {}", w, names[index], texts[index]));
    texts[index] = equals == w.npos ? w : w.substr(equals + 1);
  }
  if (texts[0].empty()) texts[0] = fmt::format("out/{}.####.exr", names[0]);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) texts[i] = beside(texts[0], names[i]);
    for (std::size_t j = 0; j < i; ++j)
      if (texts[i] == texts[j])
        throw Error(Exit::usage,
                    fmt::format("outputs '{}' and '{}' would both go to {}", names[j], names[i], texts[i]));
    patterns_.emplace_back(texts[i]);
    if (several_frames && !patterns_.back().numbered())
      throw Error(Exit::usage,
                  fmt::format("-o {}: every frame would go to this one file; put #### where the frame number belongs",
                              texts[i]));
    const bool shown = preview && shows(types_[i]) && fs::path(texts[i]).extension() != ".png";
    previews_.emplace_back(shown ? fs::path(texts[i]).replace_extension(".png").string() : "");
  }
}

void FileSink::write(std::int64_t frame, std::span<const quell_image> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    write_image(patterns_[i].path(frame), outputs[i], types_[i], options_);
    if (!previews_[i].text().empty()) write_image(previews_[i].path(frame), outputs[i], types_[i], options_);
  }
}

}  // namespace quell
