// Text forms. Delayed lines are dashed, lines that carry a weight coloured, as in the picture.
#include "core/graph/draw.h"

#include "core/graph/drawing.h"

#include <fmt/format.h>

namespace quell {

namespace {

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return '"' + out + '"';
}

std::string label(const Line& l) { return l.delay ? fmt::format("{} @-{}", l.text, l.delay) : l.text; }

}  // namespace

std::string draw_dot(const Graph& g) {
  const Boxes drawing = boxes_of(g);
  std::string out = fmt::format(
      "digraph {} {{\n  node [shape=box, fontname=\"sans-serif\"];\n  edge [fontname=\"sans-serif\", fontsize=9];\n",
      quoted(g.name.empty() ? "graph" : g.name));
  for (std::size_t i = 0; i < drawing.boxes.size(); ++i) {
    const auto& b = drawing.boxes[i];
    const char* style = "";
    if (b.kind == Box::Kind::input) style = ", style=rounded, color=\"#2b6cb0\"";
    if (b.kind == Box::Kind::weight) style = ", color=\"#c05621\"";
    if (b.kind == Box::Kind::output) style = ", style=rounded, color=\"#2f855a\"";
    out += fmt::format("  n{} [label=\"{}\\n{}\", tooltip={}{}];\n", i, b.name, b.below, quoted(b.detail), style);
  }
  for (const auto& l : drawing.lines) {
    std::string style;
    // A line into the past must not pull its reader below what it reads.
    if (l.delay) style += ", style=dashed, constraint=false";
    if (l.start) style += ", style=dotted";
    if (l.weight) style += ", color=\"#c05621\"";
    out += fmt::format("  n{} -> n{} [label={}{}];\n", l.from, l.to, quoted(label(l)), style);
  }
  return out + "}\n";
}

std::string draw_mermaid(const Graph& g) {
  const Boxes drawing = boxes_of(g);
  std::string out = "flowchart TD\n", weights;
  for (std::size_t i = 0; i < drawing.boxes.size(); ++i) {
    const auto& b = drawing.boxes[i];
    const bool round = b.kind == Box::Kind::input || b.kind == Box::Kind::output;
    out += fmt::format("  n{}{}\"{}<br/><small>{}</small>\"{}\n", i, round ? "([" : "[", b.name, b.below,
                       round ? "])" : "]");
  }
  for (std::size_t i = 0; i < drawing.lines.size(); ++i) {
    const auto& l = drawing.lines[i];
    out += fmt::format("  n{} {}|\"{}\"| n{}\n", l.from, l.delay || l.start ? "-.->" : "-->", label(l), l.to);
    if (l.weight) weights += fmt::format("{}{}", weights.empty() ? "" : ",", i);
  }
  if (!weights.empty()) out += fmt::format("  linkStyle {} stroke:#c05621\n", weights);
  return out;
}

}  // namespace quell
