// A graph's identity: everything that decides its results, as text and as a hash.
#include "core/graph/graph.h"

#include <quell/types.h>

#include <fmt/format.h>

namespace quell {

namespace {

std::string shown(const Graph& g, const Source& s) {
  if (s.node == Source::kNone) return "-";
  if (s.node == Source::kInput) return g.inputs[std::size_t(s.port)].name;
  const auto& node = g.nodes[std::size_t(s.node)];
  return node.name + "." + node.type().outputs()[std::size_t(s.port)].name;
}

std::string shown(const Graph& g, const Wire& w) {
  std::string text = shown(g, w.from);
  if (w.delay) text += fmt::format("@-{}", w.delay);
  if (w.start.node != Source::kNone) text += "|" + shown(g, w.start);
  return text;
}

}  // namespace

std::string fingerprint_text(const Graph& g) {
  std::string text;
  for (const auto& input : g.inputs) text += fmt::format("input {}:{}\n", input.name, type_name(input.type));
  for (const auto& node : g.nodes) {
    if (node.preview) continue;
    text += fmt::format("node {} = {} {}\n", node.name, node.type().name(), node.type().version());
    if (const auto params = node.instance.describe(); !params.empty()) text += "  set " + params + "\n";
    for (std::size_t p = 0; p < node.in.size(); ++p)
      for (const auto& wire : node.in[p])
        text += fmt::format("  in {} {}\n", node.type().inputs()[p].name, shown(g, wire));
  }
  for (const auto& output : g.outputs)
    if (!output.tap)  // shows what is computed anyway
      text += fmt::format("output {} {}\n", output.name, shown(g, output.wire));
  return text;
}

std::string fingerprint(const Graph& g) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const unsigned char c : fingerprint_text(g)) hash = (hash ^ c) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

}  // namespace quell
