// Finds node types: a run opens only the libraries that its graph names.
#pragma once

#include "core/plugin/node_type.h"

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace quell {

// Why a library gave no nodes.
struct PluginProblem {
  std::filesystem::path file;
  std::string text;
};

class Registry {
 public:
  // Folders are searched in order; each holds <node>.so files.
  explicit Registry(std::vector<std::filesystem::path> folders);

  // Registers the nodes of a table that is linked into the program.
  void add_static(const quell_plugin_table*);

  // The node type, opening <name>.so if need be; nullptr when there is none or its library was refused.
  const NodeType* find(std::string_view name);
  // Opens every library, once, and gives all node types by name.
  std::vector<const NodeType*> all();
  // Names of all node types that might exist, from file names, without opening anything.
  std::vector<std::string> names() const;
  // What was refused so far. After all(): everything that is wrong with the folders.
  const std::vector<PluginProblem>& problems() const { return problems_; }
  // The problem of the library that should hold `name`, or nullptr.
  const PluginProblem* problem(std::string_view name) const;
  const std::vector<std::filesystem::path>& folders() const { return folders_; }

 private:
  void open(const std::filesystem::path& file);
  void add(const quell_plugin_table*, const std::filesystem::path& file);

  std::vector<std::filesystem::path> folders_;
  std::deque<NodeType> types_;
  std::map<std::string, const NodeType*, std::less<>> by_name_;
  std::set<std::filesystem::path> opened_;
  std::vector<PluginProblem> problems_;
};

// What is wrong with a table, a sentence each; empty when it may be registered. Reads nothing that the table does not
// vouch for.
std::vector<std::string> validate(const quell_plugin_table*);

}  // namespace quell
