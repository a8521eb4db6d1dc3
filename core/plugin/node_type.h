// A registered node type, and instances of it.
#pragma once

#include <quell/abi.h>

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// A validated row of a plugin's table. Lives as long as the process.
class NodeType {
 public:
  NodeType(const quell_node* table, const quell_plugin_table* plugin, std::filesystem::path file)
      : table_(table), plugin_(plugin), file_(std::move(file)) {}

  const quell_node& table() const { return *table_; }
  std::string_view name() const { return table_->name; }
  std::string_view version() const { return plugin_->version; }
  const quell_plugin_table& plugin() const { return *plugin_; }
  const std::filesystem::path& file() const { return file_; }  // "" for a plugin linked into the program
  bool is_weight() const { return table_->weigh != nullptr; }

  std::span<const quell_port> inputs() const { return {table_->in, std::size_t(table_->in_count)}; }
  std::span<const quell_port> outputs() const { return {table_->out, std::size_t(table_->out_count)}; }
  std::span<const quell_param> params() const { return {table_->param, std::size_t(table_->param_count)}; }
  int find_input(std::string_view name) const;   // index or -1
  int find_output(std::string_view name) const;  // index or -1
  int find_param(std::string_view name) const;   // index or -1
  // Whether all wires of this input of type any have the one type that the node's other such ports have: not those of a
  // list where no output takes the type over.
  bool shares_type(const quell_port& input) const;

 private:
  const quell_node* table_;
  const quell_plugin_table* plugin_;
  std::filesystem::path file_;
};

// Parameters of one use of a node: a copy of the defaults that owns its texts. Values are checked by the caller.
class Instance {
 public:
  explicit Instance(const NodeType&);
  Instance(const Instance&);
  Instance(Instance&&) noexcept = default;
  Instance& operator=(const Instance& other) { return *this = Instance(other); }
  Instance& operator=(Instance&&) noexcept = default;

  const NodeType& type() const { return *type_; }
  const void* data() const { return bytes_.get(); }

  void set_bool(int param, bool);
  void set_int(int param, int);  // also the index of a choice
  void set_float(int param, float);
  void set_floats(int param, std::span<const float>);
  void set_text(int param, std::string);  // also a path

  bool get_bool(int param) const;
  int get_int(int param) const;
  float get_float(int param) const;
  std::span<const float> get_floats(int param) const;
  std::string_view get_text(int param) const;

  // "step=2 sigma=1": every parameter with its value, in order, exact; for hashes and reports.
  std::string describe() const;

  std::vector<quell_reach> reach() const;  // one an input port

 private:
  struct Free {
    void operator()(std::byte* p) const;
  };
  std::byte* at(int param);
  const std::byte* at(int param) const;
  const NodeType* type_;
  std::unique_ptr<std::byte, Free> bytes_;
  std::deque<std::pair<int, std::string>> texts_;  // a deque, for the instance points into them
};

}  // namespace quell
