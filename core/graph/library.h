// Opens graph files: installed ones, files beside others, and variants together with their bases.
#pragma once

#include "core/graph/document.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quell {

// "quell:scenes/room.json" for a file below the folder of installed graphs; nothing for another.
std::optional<std::string> installed_name(const std::filesystem::path& graphs, const std::filesystem::path& file);

class Library {
 public:
  // `graphs` is the folder of installed graphs.
  Library(std::filesystem::path graphs, Faults& faults) : graphs_(std::move(graphs)), faults_(faults) {}

  // The graph that a command names: a path, or an installed graph when it has neither a slash nor ".json". `text`
  // stands for the file's content when it is given; `laid_over` is one more variant.
  const Document* open_root(const std::string& graph, const std::optional<std::string>& text,
                            const std::optional<Json>& laid_over);
  // The graph that the text at `position` names. It lies below the folder of that text's file, or is "quell:…".
  const Document* open(const std::string& written, TextPosition position, const std::string& path);

  // The file that "quell:…" names; nothing when it would leave the folder of installed graphs.
  std::optional<std::filesystem::path> installed(const std::string& written) const;
  // Names of installed graphs.
  std::vector<std::string> names() const;

 private:
  struct Layers {
    Json json;
    std::vector<Change> changes;
  };
  std::optional<std::filesystem::path> locate(const std::string& written, TextPosition, const std::string& path);
  std::optional<Layers> flatten(Json json, std::vector<std::string>& files);
  const Document* keep(const std::string& file, std::optional<Json> json);

  std::filesystem::path graphs_;
  Faults& faults_;
  std::filesystem::path root_folder_;
  std::map<std::string, std::unique_ptr<Document>> documents_;  // by path; null when it had errors
};

}  // namespace quell
