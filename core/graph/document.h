// A graph file as written: nothing is looked up yet, and everything knows where it stands.
#pragma once

#include "core/graph/faults.h"
#include "core/graph/metric_key.h"
#include "core/graph/reference.h"
#include "core/json/json.h"

#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace quell {

struct WireSpec {
  TextPosition position;
  Reference from;
  std::optional<Reference> start;
  TextPosition start_position;
  int as = 0;      // quell_type of an explicit cast; 0: none
  int scope = -1;  // where its names are looked up; -1: where its reader stands
};

struct Binding {
  std::string port;
  TextPosition position;
  bool list = false;  // written as a list
  std::vector<WireSpec> wires;
};

struct Setting {
  std::string name;
  TextPosition position;
  Json value;
  int scope = -1;  // where "$name" is looked up; -1: where its node stands
};

struct NodeSpec {
  std::string name;  // "atrous"; in a graph that was written with its subgraphs opened up also "level0.atrous"
  TextPosition position;
  bool graph = false;  // a graph used as a node
  std::string type;    // a node type, or the path of a graph
  TextPosition type_position;
  bool bypass = false;
  TextPosition bypass_position;
  bool swapped = false;  // by a variant: what does not fit the new type is dropped
  std::vector<Binding> in;
  std::vector<Setting> set;
};

struct InputSpec {
  std::string name;
  TextPosition position;
  int type = 0;
  bool optional = false, list = false;
};

struct ParamSpec {
  std::string name;
  TextPosition position;
  Json value;
};

struct OutputSpec {
  std::string name;
  TextPosition position;
  WireSpec wire;
};

// A short form of a variant or an option of the command line.
struct Change {
  enum class Kind { swap, wire, bypass, set };  // in the order in which they are applied
  Kind kind;
  std::vector<std::string> target;  // "level0.atrous.step" in parts
  TextPosition position;
  Json value;                   // of set
  Binding binding;              // of wire; no wires: disconnect
  std::string type;             // of swap
  TextPosition value_position;  // of swap and bypass
};

struct Document {
  std::string file;  // as it was opened
  TextPosition position;
  std::string name, about;
  std::optional<MetricKey> metric;  // of a graph that judges images
  std::vector<InputSpec> inputs;
  std::vector<ParamSpec> params;
  std::vector<NodeSpec> nodes;
  std::vector<OutputSpec> outputs;
  std::vector<Change> changes;  // of this variant and its bases, bases first

  int find_input(const std::string& n) const { return find(input_index, n); }
  int find_param(const std::string& n) const { return find(param_index, n); }
  int find_node(const std::string& n) const { return find(node_index, n); }
  int find_output(const std::string& n) const { return find(output_index, n); }
  // The node that the first parts of a path name, and how many those are; -1 and 0 when there is none.
  struct Found {
    int node = -1;
    std::size_t parts = 0;
  };
  Found find_node(std::span<const std::string> path) const;

  using Index = std::unordered_map<std::string, int>;
  Index input_index, param_index, node_index, output_index;

 private:
  static int find(const Index& index, const std::string& name) {
    const auto it = index.find(name);
    return it == index.end() ? -1 : it->second;
  }
};

// The whole of a graph without a base, or of a variant laid over its base. Nothing when there were errors.
std::optional<Document> parse_document(const Json&, Faults&);

// Parts of it, which the short forms share. They report under `path`.
std::optional<Binding> parse_binding(const std::string& port, TextPosition, const Json&, const std::string& path,
                                     Faults&);

}  // namespace quell
