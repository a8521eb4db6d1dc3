// Attributes of pictures, put together frame by frame.
#include "core/run/provenance.h"

#include "core/graph/write.h"
#include "core/report/shell.h"
#include "core/run/named_files.h"
#include "core/sequence/file_hash.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quell {

namespace {

namespace fs = std::filesystem;
using J = nlohmann::ordered_json;

// Names of files need not be UTF-8.
std::string text_of(const J& json) { return json.dump(-1, ' ', false, J::error_handler_t::replace); }

std::string whole_path(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path, error).lexically_normal().string();
}

}  // namespace

std::string plugin_versions(const Graph& graph, const NodeType* source) {
  std::map<std::string, std::string> versions;
  if (source) versions.emplace(source->name(), source->version());
  for (const auto& node : graph.nodes)
    if (!node.preview) versions.emplace(node.type().name(), node.type().version());
  std::vector<std::string> texts;
  for (const auto& [name, version] : versions) texts.push_back(fmt::format("{} {}", name, version));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string short_hash(const std::string& inputs) { return text_hash(inputs).substr(8); }

Provenance::Provenance(const Graph& graph, FrameSource& source, const Run& run) {
  const auto written = write_graph(graph, run.graphs);
  texts_ = {{"Software", "quell " QUELL_VERSION},
            {"quell:version", QUELL_VERSION},
            {"quell:simd", run.simd},
            {"quell:plugins", plugin_versions(graph, run.source)},
            {"quell:command", shell_text(run.command)},
            {"quell:directory", whole_path(".")},
            {"quell:graph", written.text},
            {"quell:fingerprint", fingerprint(graph)},
            {"quell:sequence", source.description(run.graphs)}};
  if (!written.files.empty()) texts_["quell:files"] = text_of(written.files);
  if (run.missing != "error") texts_["quell:missing"] = run.missing;
  std::error_code error;
  if (fs::is_regular_file(run.load_state, error))  // else the run refuses it
    texts_["quell:state"] =
        text_of({{"file", whole_path(run.load_state)}, {"hash", file_hash(run.load_state.string())}});
  for (const auto& node : graph.nodes)
    if (!node.preview) named_.merge(named_files(node.name, node.instance));
  if (!source.frames().empty()) first_ = source.frames().front();
  source.watch_files([this](std::int64_t frame, const std::string& name, const std::string& hash) {
    const std::scoped_lock lock(mutex_);
    files_[frame][name] = hash;
  });
}

void Provenance::history_begins(std::int64_t frame) {
  first_ = frame;
  history_.clear();
  texts_.erase("quell:state");
}

Texts Provenance::files(std::int64_t frame) const {
  Texts files = named_;
  const std::scoped_lock lock(mutex_);
  if (const auto it = files_.find(frame); it != files_.end()) files.insert(it->second.begin(), it->second.end());
  return files;
}

Texts Provenance::texts(std::int64_t frame) {
  Texts texts = texts_;
  const std::string inputs = text_of(files(frame));
  texts["quell:frames"] = first_ == frame ? fmt::format("{}", frame) : fmt::format("{}-{}", first_, frame);
  texts["quell:inputs"] = inputs;
  if (!history_.empty()) texts["quell:history"] = history_;
  history_ += fmt::format("{}{}", history_.empty() ? "" : " ", short_hash(inputs));
  return texts;
}

std::string Provenance::report() const {
  J json;
  for (const auto& [key, text] : texts_) {
    if (!key.starts_with("quell:")) continue;
    const bool structured =
        key == "quell:graph" || key == "quell:sequence" || key == "quell:files" || key == "quell:state";
    json[key.substr(6)] = structured && !text.empty() ? J::parse(text) : J(text);
  }
  auto& inputs = json["inputs"] = J::object();
  const std::scoped_lock lock(mutex_);
  for (const auto& [frame, files] : files_) {
    auto& all = inputs[std::to_string(frame)] = files;
    for (const auto& [name, hash] : named_) all[name] = hash;
  }
  return text_of(json);
}

}  // namespace quell
