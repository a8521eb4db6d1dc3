// A graph as boxes and lines: what all forms of drawing share, and the layered layout for SVG.
#pragma once

#include "core/graph/graph.h"

#include <string>
#include <utility>
#include <vector>

namespace quell {

struct Box {
  enum class Kind { input, node, weight, output };
  Kind kind;
  std::string name;    // "level0.atrous"
  std::string below;   // node type, or type of the image
  std::string detail;  // parameters
};

struct Line {
  int from, to;      // boxes
  std::string text;  // "image → current"
  int delay = 0;
  bool weight = false;
  bool start = false;
};

struct Boxes {
  std::vector<Box> boxes;  // inputs, nodes in order, outputs
  std::vector<Line> lines;
};

Boxes boxes_of(const Graph&);

struct Point {
  double x, y;
};

struct Layout {
  double width = 0, height = 0;
  std::vector<Point> box;                // centres
  std::vector<std::vector<Point>> line;  // corners of undelayed lines, from top to bottom; empty for others
};

// Ranks from top to bottom by the undelayed lines; boxes of one rank side by side. `widths` are those of the boxes.
Layout lay_out(const Boxes&, const std::vector<double>& widths, double row_height);

}  // namespace quell
