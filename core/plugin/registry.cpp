// Loads plugin libraries and keeps their node types.
#include "core/plugin/registry.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>

namespace quell {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> libraries_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".so") files.push_back(it->path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

Registry::Registry(std::vector<fs::path> folders) : folders_(std::move(folders)) {}

void Registry::add_static(const quell_plugin_table* table) { add(table, {}); }

const NodeType* Registry::find(std::string_view name) {
  if (const auto it = by_name_.find(name); it != by_name_.end()) return it->second;
  // A name from a graph becomes a file name: nothing but a node's name may pass.
  if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != name.npos) return nullptr;
  for (const auto& folder : folders_) {
    const fs::path file = folder / (std::string(name) + ".so");
    std::error_code error;
    if (!fs::exists(file, error)) continue;
    open(file);
    if (const auto it = by_name_.find(name); it != by_name_.end()) return it->second;
    if (!problem(name)) problems_.push_back({file, fmt::format("holds no node type '{}'", name)});
  }
  return nullptr;
}

std::vector<const NodeType*> Registry::all() {
  for (const auto& folder : folders_)
    for (const auto& file : libraries_in(folder)) open(file);
  std::vector<const NodeType*> types;
  for (const auto& [name, type] : by_name_) types.push_back(type);
  return types;
}

std::vector<std::string> Registry::names() const {
  std::set<std::string> names;
  for (const auto& [name, type] : by_name_) names.insert(name);
  for (const auto& folder : folders_)
    for (const auto& file : libraries_in(folder)) names.insert(file.stem().string());
  return {names.begin(), names.end()};
}

const PluginProblem* Registry::problem(std::string_view name) const {
  for (const auto& p : problems_)
    if (p.file.stem().string() == name) return &p;
  return nullptr;
}

void Registry::open(const fs::path& file) {
  if (!opened_.insert(file).second) return;
  // Never closed: node types point into the library, and threads may still be in its thread-local destructors at exit.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    const char* error = dlerror();
    std::string why = error ? error : "cannot be opened";
    if (const auto name = file.string() + ": "; why.starts_with(name)) why.erase(0, name.size());
    problems_.push_back({file, std::move(why)});
    return;
  }
  const auto function = reinterpret_cast<quell_plugin_function>(dlsym(library, "quell_plugin"));
  if (!function) {
    problems_.push_back({file, "exports no function quell_plugin: not a Quell plugin"});
    return;
  }
  add(function(), file);
}

void Registry::add(const quell_plugin_table* table, const fs::path& file) {
  const auto wrong = validate(table);
  if (!wrong.empty()) {
    problems_.push_back({file, fmt::format("{}", fmt::join(wrong, "; "))});
    return;
  }
  for (int i = 0; i < table->node_count; ++i) {
    const auto it = by_name_.find(std::string_view(table->nodes[i]->name));
    if (it == by_name_.end()) continue;
    const auto& first = it->second->file();
    problems_.push_back({file, fmt::format("node type '{}' is already registered by {}", table->nodes[i]->name,
                                           first.empty() ? "the program itself" : first.string())});
    return;
  }
  for (int i = 0; i < table->node_count; ++i) {
    const auto& type = types_.emplace_back(table->nodes[i], table, file);
    by_name_.emplace(table->nodes[i]->name, &type);
  }
}

}  // namespace quell
