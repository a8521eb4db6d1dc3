// Draws a graph: for Graphviz, for Markdown, or as a picture that needs no other program.
#pragma once

#include "core/graph/graph.h"

#include <string>

namespace quell {

std::string draw_dot(const Graph&);
std::string draw_mermaid(const Graph&);
std::string draw_svg(const Graph&);

}  // namespace quell
