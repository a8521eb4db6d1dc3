// A graph from a stranger reads no file outside its folder: paths are checked before anything is opened.
#include "core/graph/library.h"

#include "core/graph/variant.h"
#include "core/report/suggest.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBases = 16;
constexpr std::string_view kInstalled = "quell:";

bool plain_name(const std::string& graph) {
  return graph.find('/') == graph.npos && !graph.ends_with(".json") && !graph.starts_with(kInstalled);
}

// Stays below the folder that it is appended to.
bool below(const fs::path& relative) {
  const fs::path normal = relative.lexically_normal();
  return !relative.empty() && !relative.has_root_path() && normal.begin() != normal.end() && *normal.begin() != "..";
}

// A source whose name begins with -- is an option, and options are trusted with more than files are.
std::string source_name(const fs::path& file) {
  const std::string name = file.generic_string();
  return name.starts_with("--") ? "./" + name : name;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

}  // namespace

std::optional<std::string> installed_name(const fs::path& graphs, const fs::path& file) {
  std::error_code error;
  const auto rest =
      fs::absolute(file, error).lexically_normal().lexically_relative(fs::absolute(graphs, error).lexically_normal());
  if (!below(rest) || rest == ".") return std::nullopt;
  return std::string(kInstalled) + rest.generic_string();
}

std::vector<std::string> Library::names() const {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(graphs_, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".json") names.push_back(it->path().stem().string());
  std::ranges::sort(names);
  return names;
}

std::optional<fs::path> Library::installed(const std::string& written) const {
  const fs::path rest = written.substr(std::min(written.size(), kInstalled.size()));
  if (!written.starts_with(kInstalled) || !below(rest)) return std::nullopt;
  return (graphs_ / rest).lexically_normal();
}

std::optional<fs::path> Library::locate(const std::string& written, TextPosition position, const std::string& path) {
  std::optional<fs::path> file;
  if (written.starts_with(kInstalled)) {
    file = installed(written);
  } else if (below(written)) {
    const auto& source = faults_.sources().name(position.source);
    const fs::path folder = source.starts_with("--") ? root_folder_ : fs::path(source).parent_path();
    file = (folder / written).lexically_normal();
  }
  if (!file) {
    faults_.error(position, path, fmt::format("'{}' leads out of the folder of its graph", written),
                  {"a graph lies below the folder of the file that names it, or is installed: quell:parts/level.json"});
    return std::nullopt;
  }
  if (is_file(*file)) return file;
  faults_.error(position, path, fmt::format("there is no graph '{}'", written),
                {fmt::format("looked for {}", file->generic_string())});
  return std::nullopt;
}

const Document* Library::open(const std::string& written, TextPosition position, const std::string& path) {
  const auto file = locate(written, position, path);
  if (!file) return nullptr;
  const std::string name = source_name(*file);
  if (const auto it = documents_.find(name); it != documents_.end()) return it->second.get();
  return keep(name, parse_json_file(name, faults_.diagnostics()));
}

const Document* Library::open_root(const std::string& graph, const std::optional<std::string>& text,
                                   const std::optional<Json>& laid_over) {
  fs::path file = graph;
  if (!text && plain_name(graph)) {
    file = graphs_ / (graph + ".json");
    if (!is_identifier(graph) || !is_file(file)) {
      const auto known = names();
      faults_.error({}, "", fmt::format("there is no graph '{}'", graph),
                    {possibilities("installed are", graph, known), "a file is named with its folder or with .json"});
      return nullptr;
    }
  } else if (!text && graph.starts_with(kInstalled)) {
    file = installed(graph).value_or(graph);
  }
  root_folder_ = file.parent_path();
  const std::string name = source_name(file);
  auto json = text ? parse_json(name, *text, faults_.diagnostics()) : parse_json_file(name, faults_.diagnostics());
  if (json && laid_over) {
    std::vector<std::string> files{name};
    auto layers = flatten(std::move(*json), files);
    if (!layers) return nullptr;
    auto changes = parse_changes(*laid_over, faults_);
    drop_overridden(layers->changes, *laid_over);
    const auto& document = keep(name, overlay(std::move(layers->json), *laid_over, faults_));
    if (!document) return nullptr;
    auto& all = documents_[name]->changes;
    all = std::move(layers->changes);
    all.insert(all.end(), std::make_move_iterator(changes.begin()), std::make_move_iterator(changes.end()));
    return faults_.ok() ? document : nullptr;
  }
  return keep(name, std::move(json));
}

std::optional<Library::Layers> Library::flatten(Json json, std::vector<std::string>& files) {
  const Json* base = json.find("base");
  if (!base) {
    bool good = true;
    for (const auto& m : json.members) {
      if (m.key != "set" && m.key != "swap" && m.key != "wire" && m.key != "bypass") continue;
      faults_.error(m.key_position, m.key, fmt::format("\"{}\" belongs to a variant, which names its \"base\"", m.key));
      good = false;
    }
    return good ? std::optional(Layers{std::move(json), {}}) : std::nullopt;
  }
  if (!base->is(Json::Kind::text)) {
    faults_.error(base->position, "base", fmt::format("\"base\" must name a graph, not {}", base->shown()));
    return std::nullopt;
  }
  const std::string written = plain_name(base->text) ? fmt::format("quell:{}.json", base->text) : base->text;
  const auto file = locate(written, base->position, "base");
  if (!file) return std::nullopt;
  const std::string name = source_name(*file);
  const bool again = std::ranges::find(files, name) != files.end();
  files.push_back(name);
  if (again || files.size() > kMaxBases) {
    faults_.error(base->position, "base",
                  again ? "a graph cannot be its own base" : fmt::format("more than {} bases", kMaxBases),
                  {fmt::format("{}", fmt::join(files, " → "))});
    return std::nullopt;
  }
  auto below = parse_json_file(name, faults_.diagnostics());
  if (!below) return std::nullopt;
  auto layers = flatten(std::move(*below), files);
  if (!layers) return std::nullopt;
  auto changes = parse_changes(json, faults_);
  drop_overridden(layers->changes, json);
  layers->json = overlay(std::move(layers->json), json, faults_);
  layers->changes.insert(layers->changes.end(), std::make_move_iterator(changes.begin()),
                         std::make_move_iterator(changes.end()));
  return layers;
}

const Document* Library::keep(const std::string& file, std::optional<Json> json) {
  auto& kept = documents_[file];
  if (!json) return nullptr;
  std::vector<std::string> files{file};
  auto layers = flatten(std::move(*json), files);
  if (!layers) return nullptr;
  auto document = parse_document(layers->json, faults_);
  if (!document) return nullptr;
  document->file = file;
  document->changes = std::move(layers->changes);
  kept = std::make_unique<Document>(std::move(*document));
  return kept.get();
}

}  // namespace quell
