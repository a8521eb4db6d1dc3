// Names, describes and writes the error images of a comparison.
#include "apps/quell/error_maps.h"

#include "core/report/error.h"
#include "core/sequence/image_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace quell {

namespace fs = std::filesystem;

namespace {

// What a picture's files are called by: its name, or the path that it has, without the frame number and flat:
// "out/color.####.exr" is out_color.
std::string stem_of(const Pictures& picture) {
  if (picture.name != picture.text) return picture.name;
  const std::string path = fs::path(picture.text).replace_extension().string();
  std::string stem;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto number = path[i] == '%' ? path.find_first_not_of("0123456789", i + 1) : path.npos;
    const bool formatted = number != path.npos && path[number] == 'd';
    if (path[i] == '#' || path[i] == '@' || formatted) {
      while (!stem.empty() && std::string_view("._-").find(stem.back()) != std::string_view::npos) stem.pop_back();
      if (formatted) i = number;
    } else {
      stem += path[i] == '/' || path[i] == '%' ? '_' : path[i];
    }
  }
  stem.erase(0, stem.find_first_not_of("._"));  // of "../" and of an absolute path
  return stem.empty() ? "picture" : stem;
}

}  // namespace

ErrorMaps::ErrorMaps(std::string folder, const std::vector<Pictures>& pictures) : folder_(std::move(folder)) {
  if (!wanted()) return;
  for (const auto& picture : pictures) {
    auto stem = stem_of(picture);
    if (const auto same = std::ranges::find(stems_, stem); same != stems_.end())
      throw Error(Exit::usage, fmt::format("the maps of '{}' and of '{}' would both be called '{}'; NAME=… names the "
                                           "pictures apart",
                                           pictures[std::size_t(same - stems_.begin())].text, picture.text, stem));
    stems_.push_back(std::move(stem));
  }
}

std::size_t ErrorMaps::add(std::size_t picture, const std::string& metric, Graph graph) {
  const auto file = [&](const char* extension) {
    return FramePattern(
        (fs::path(folder_) / fmt::format("{}.{}.####.{}", stems_[picture], metric, extension)).string());
  };
  maps_.push_back({std::move(graph), file("exr"), file("png")});
  return maps_.size() - 1;
}

std::vector<std::string> ErrorMaps::files(std::int64_t frame) const {
  std::vector<std::string> all;
  for (const auto& map : maps_)
    for (const auto* pattern : {&map.exr, &map.png}) all.push_back(plain_path(pattern->path(frame)));
  return all;
}

void ErrorMaps::begin(FrameSource& source, const FileLog& log, const Provenance::Run& run) {
  for (auto& map : maps_) map.provenance.emplace(map.graph, source, log, run);
}

void ErrorMaps::history_begins(std::int64_t frame) {
  for (auto& map : maps_) map.provenance->history_begins(frame);
}

void ErrorMaps::begin_frame(std::int64_t frame) {
  for (auto& map : maps_) map.texts = map.provenance->texts(frame);
}

void ErrorMaps::write(std::size_t index, std::int64_t frame, const quell_image& image,
                      const GraphOutput& output) const {
  const Map& map = maps_[index];
  const bool preview = output.shows >= 0;
  GraphOutput written = map.graph.outputs[0];
  written.type = output.type;
  if (preview) written.shows = 0;
  WriteOptions options;
  options.metadata = map.texts;
  options.metadata["quell:output"] = output_text(map.graph, written, options);
  write_image((preview ? map.png : map.exr).path(frame), image, output.type, options);
}

}  // namespace quell
