// Boxes and lines of a graph.
#include "core/graph/drawing.h"

#include <quell/types.h>

#include <fmt/format.h>

namespace quell {

Boxes boxes_of(const Graph& g) {
  Boxes out;
  for (const auto& in : g.inputs) out.boxes.push_back({Box::Kind::input, in.name, std::string(type_name(in.type)), ""});
  for (const auto& n : g.nodes)
    out.boxes.push_back({n.type().is_weight() ? Box::Kind::weight : Box::Kind::node, n.name,
                         std::string(n.type().name()), n.instance.describe()});
  for (const auto& o : g.outputs) out.boxes.push_back({Box::Kind::output, o.name, std::string(type_name(o.type)), ""});

  const int first = int(g.inputs.size());
  const auto box = [&](const Source& s) { return s.node == Source::kInput ? s.port : first + s.node; };
  const auto port = [&](const Source& s) -> std::string {
    return s.node == Source::kInput ? "" : g.nodes[std::size_t(s.node)].type().outputs()[std::size_t(s.port)].name;
  };
  const auto add = [&](const Wire& w, int to, const std::string& into) {
    const bool weight = g.type_of(w.from) == QUELL_WEIGHT;
    const auto text = [&](const Source& source) {
      const std::string from = port(source);
      return from.empty() ? into : from + " → " + into;
    };
    out.lines.push_back({box(w.from), to, text(w.from), w.delay, weight, false});
    if (w.start.node != Source::kNone)
      out.lines.push_back({box(w.start), to, text(w.start) + " at the start", 0, false, true});
  };
  for (std::size_t n = 0; n < g.nodes.size(); ++n)
    for (std::size_t p = 0; p < g.nodes[n].in.size(); ++p)
      for (const auto& w : g.nodes[n].in[p]) add(w, first + int(n), g.nodes[n].type().inputs()[p].name);
  for (std::size_t o = 0; o < g.outputs.size(); ++o)
    add(g.outputs[o].wire, first + int(g.nodes.size() + o), g.outputs[o].name);
  return out;
}

}  // namespace quell
