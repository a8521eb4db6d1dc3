// Attributes of pictures, put together frame by frame.
#include "core/run/provenance.h"

#include "core/graph/write.h"
#include "core/report/shell.h"
#include "core/report/suggest.h"
#include "core/run/named_files.h"
#include "core/sequence/file_hash.h"

#include <quell/types.h>

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

std::string plugin_versions(const Graph& graph, const FrameSource& source) {
  auto versions = source.plugins(names_of(graph.inputs));
  for (const auto& node : graph.nodes)
    if (!node.preview) versions.emplace(node.type().name(), node.type().version());
  std::vector<std::string> texts;
  for (const auto& [name, version] : versions) texts.push_back(fmt::format("{} {}", name, version));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string short_hash(const std::string& inputs) { return text_hash(inputs).substr(8); }

Provenance::Provenance(const Graph& graph, const FrameSource& source, const FileLog& log, const Run& run)
    : log_(&log), roles_(names_of(graph.inputs)), looks_back_(graph.looks_back()) {
  const auto written = write_graph(graph, run.graphs);
  texts_ = {{"Software", "quell " QUELL_VERSION},
            {"quell:version", QUELL_VERSION},
            {"quell:simd", run.simd},
            {"quell:plugins", plugin_versions(graph, source)},
            {"quell:command", shell_text(run.command)},
            {"quell:directory", whole_path(".")},
            {"quell:graph", written.text},
            {"quell:fingerprint", fingerprint(graph)},
            {"quell:sequence", source.description(run.graphs, roles_)}};
  if (!written.files.empty()) texts_["quell:files"] = text_of(written.files);
  if (run.missing != "error") texts_["quell:missing"] = run.missing;
  std::error_code error;
  if (fs::is_regular_file(run.load_state, error))  // else the run refuses it
    texts_["quell:state"] =
        text_of({{"file", whole_path(run.load_state)}, {"hash", file_hash(run.load_state.string())}});
  for (const auto& node : graph.nodes)
    if (!node.preview) named_.merge(named_files(node.name, node.instance));
  if (!source.frames().empty()) first_ = source.frames().front();
}

void Provenance::history_begins(std::int64_t frame) {
  first_ = frame;
  history_.clear();
  texts_.erase("quell:state");
}

Texts Provenance::files(std::int64_t frame) const {
  Texts files = log_->files(frame, roles_);
  files.insert(named_.begin(), named_.end());
  return files;
}

Texts Provenance::texts(std::int64_t frame) {
  if (!looks_back_ && !texts_.contains("quell:state")) first_ = frame, history_.clear();
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
  for (const auto frame : log_->frames()) inputs[std::to_string(frame)] = files(frame);
  return text_of(json);
}

std::string output_text(const Graph& graph, const GraphOutput& output, const WriteOptions& options) {
  J json{{"name", output.name}, {"type", type_name(output.type)}};
  if (output.shows >= 0) json["preview_of"] = graph.outputs[std::size_t(output.shows)].name;
  if (output.tap && output.shows < 0) json["tap"] = reference_text(graph, output.wire);
  json["half"] = options.half;
  json["compression"] = options.compression.name;
  if (options.compression.level) json["level"] = *options.compression.level;
  return json.dump();
}

}  // namespace quell
