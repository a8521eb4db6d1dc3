// Partition refinement over the nodes of all parts: all that look alike are taken to be one until what they read tells
// them apart. What is never told apart computes the same: Hopcroft's minimization of automata, for graphs with delays.
#include "core/lab/merge.h"

#include "core/report/error.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace quell {

namespace {

// Numbers for what is alike, in the order of first appearance.
template <class Key>
class Numbers {
 public:
  int of(Key key) { return numbers_.emplace(std::move(key), int(numbers_.size())).first->second; }
  std::size_t count() const { return numbers_.size(); }

 private:
  std::map<Key, int> numbers_;
};

// What a node is, whatever it reads.
std::string kind_of(const GraphNode& node) {
  std::string text = fmt::format("{} {} {} {} types", node.type().name(), node.type().version(),
                                 node.instance.describe(), node.preview);
  for (const int type : node.out_types) text += fmt::format(" {}", type);
  text += " wires";
  for (const auto& port : node.in) text += fmt::format(" {}", port.size());
  return text;
}

class Merger {
 public:
  explicit Merger(std::span<const MergePart> parts) : parts_(parts) {
    for (const auto& part : parts) gather_inputs(*part.graph);
    refine();
    assemble();
  }

  Merged merged;

 private:
  void gather_inputs(const Graph& graph) {
    auto& places = input_places_.emplace_back();
    auto& all = merged.graph.inputs;
    for (const auto& input : graph.inputs) {
      const auto it = std::ranges::find(all, input.name, &GraphInput::name);
      places.push_back(int(it - all.begin()));
      if (it == all.end())
        all.push_back(input);
      else if (it->type != input.type)
        throw Error(Exit::usage, fmt::format("'{}' is read as {} and as {}", input.name, type_name(it->type),
                                             type_name(input.type)));
      else
        it->optional = it->optional && input.optional;
    }
  }

  // A source in terms of classes: negative for what is no node.
  Source in_classes(std::size_t part, const Source& s, const std::vector<int>& classes) const {
    if (s.node == Source::kInput) return {Source::kInput, input_places_[part][std::size_t(s.port)]};
    if (s.node == Source::kNone) return s;
    return {classes[std::size_t(s.node)], s.port};
  }

  void refine() {
    std::vector<std::vector<int>> classes;
    Numbers<std::string> kinds;
    for (const auto& part : parts_) {
      auto& of_part = classes.emplace_back();
      for (const auto& node : part.graph->nodes) of_part.push_back(kinds.of(kind_of(node)));
    }
    for (std::size_t count = kinds.count(), before = 0; count != before;) {
      before = count;
      Numbers<std::vector<int>> finer;
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto coarse = classes[p];
        for (std::size_t n = 0; n < coarse.size(); ++n) {
          std::vector<int> key{coarse[n]};
          const auto add = [&](const Source& s) { key.push_back(s.node), key.push_back(s.port); };
          for (const auto& port : parts_[p].graph->nodes[n].in)
            for (const auto& wire : port) {
              // What is read undelayed stands before and has its finer class already: a long chain is told apart in
              // one round, so there are no more rounds than delays in a row.
              add(in_classes(p, wire.from, wire.delay ? coarse : classes[p]));
              key.push_back(wire.delay);
              add(in_classes(p, wire.start, classes[p]));
            }
          classes[p][n] = finer.of(std::move(key));
        }
      }
      count = finer.count();
    }
    merged.places = std::move(classes);
  }

  Wire placed(std::size_t part, const Wire& wire) const {
    return {in_classes(part, wire.from, merged.places[part]), wire.delay,
            in_classes(part, wire.start, merged.places[part])};
  }

  // Classes are numbered as their first nodes appear, and all that those read undelayed appears before them: so the
  // numbers are an order of the merged graph.
  void assemble() {
    auto& graph = merged.graph;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const auto& part = parts_[p];
      for (std::size_t n = 0; n < part.graph->nodes.size(); ++n) {
        if (std::size_t(merged.places[p][n]) != graph.nodes.size()) continue;
        auto node = part.graph->nodes[n];
        node.name = fmt::format("{}/{}", part.name, node.name);
        for (auto& port : node.in)
          for (auto& wire : port) wire = placed(p, wire);
        graph.nodes.push_back(std::move(node));
      }
      const int first = int(graph.outputs.size());
      for (auto output : part.graph->outputs) {
        output.name = fmt::format("{}/{}", part.name, output.name);
        output.wire = placed(p, output.wire);
        if (output.shows >= 0) output.shows += first;
        graph.outputs.push_back(std::move(output));
      }
    }
  }

  std::span<const MergePart> parts_;
  std::vector<std::vector<int>> input_places_;  // by part and input of it: the merged graph's
};

}  // namespace

Merged merge(std::span<const MergePart> parts) { return std::move(Merger(parts).merged); }

}  // namespace quell
