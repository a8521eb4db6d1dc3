// The picture: boxes in ranks, wires as curves between them, delayed wires dashed along the side.
#include "core/graph/draw.h"
#include "core/graph/drawing.h"
#include "core/report/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quell {

namespace {

constexpr double kBoxHeight = 38, kRow = 84, kLetter = 7.2, kPad = 20;
constexpr double kSide = 150;  // room for delayed wires

const char* style_of(Box::Kind kind) {
  switch (kind) {
    case Box::Kind::input:
      return "input";
    case Box::Kind::weight:
      return "weight";
    case Box::Kind::output:
      return "output";
    default:
      return "node";
  }
}

// Down through the waypoints, upright at each.
std::string downwards(const std::vector<Point>& points) {
  std::string path;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point a{points[i - 1].x, points[i - 1].y + (i == 1 ? kBoxHeight / 2 : 0)};
    const Point b{points[i].x, points[i].y - (i + 1 == points.size() ? kBoxHeight / 2 : 0)};
    const double middle = (a.y + b.y) / 2;
    if (i == 1) path = fmt::format("M{:.1f},{:.1f}", a.x, a.y);
    path += fmt::format(" C{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}", a.x, middle, b.x, middle, b.x, b.y);
  }
  return path;
}

// From the right side of one box to the right side of another, the wider the longer.
std::string beside(Point from, double from_width, Point to, double to_width) {
  const double x0 = from.x + from_width / 2, x1 = to.x + to_width / 2;
  const double out = std::max(x0, x1) + std::min(kSide, 30 + std::abs(from.y - to.y) / 6);
  return fmt::format("M{:.1f},{:.1f} C{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}", x0, from.y, out, from.y, out,
                     to.y + 6, x1, to.y + 6);
}

constexpr const char* kStyle = R"(<style>
  text { font-family: system-ui, sans-serif; font-size: 13px; text-anchor: middle; fill: #1a202c }
  .below { font-size: 11px; fill: #718096 }
  rect { fill: #ffffff; stroke: #4a5568 }
  .input rect { fill: #ebf8ff; stroke: #2b6cb0 } .output rect { fill: #f0fff4; stroke: #2f855a }
  .weight rect { fill: #fffaf0; stroke: #c05621 }
  path { fill: none; stroke: #718096 }
  .carries-weight { stroke: #c05621 } .delayed { stroke: #2b6cb0; stroke-dasharray: 6 4 } .start { stroke-dasharray: 2 3 }
</style>
<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">
  <path d="M0,0 L8,4 L0,8 z" style="fill: #718096; stroke: none"/></marker></defs>
)";

}  // namespace

std::string draw_svg(const Graph& g) {
  const Boxes drawing = boxes_of(g);
  std::vector<double> widths;
  for (const auto& b : drawing.boxes)
    widths.push_back(kPad + kLetter * double(std::max(b.name.size(), b.below.size())));
  const Layout layout = lay_out(drawing, widths, kRow);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n<title>{2}</title>\n",
      layout.width + kSide, layout.height, xml_text(g.name.empty() ? "graph" : g.name));
  out += kStyle;
  out += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (std::size_t i = 0; i < drawing.lines.size(); ++i) {
    const auto& l = drawing.lines[i];
    const auto from = std::size_t(l.from), to = std::size_t(l.to);
    const std::string path =
        l.delay ? beside(layout.box[from], widths[from], layout.box[to], widths[to]) : downwards(layout.line[i]);
    const char* style = l.delay ? "delayed" : l.start ? "start" : l.weight ? "carries-weight" : "plain";
    out += fmt::format("<path class=\"{}\" d=\"{}\" marker-end=\"url(#tip)\"><title>{} → {}: {}{}</title></path>\n",
                       style, path, xml_text(drawing.boxes[from].name), xml_text(drawing.boxes[to].name),
                       xml_text(l.text), l.delay ? fmt::format(", {} earlier", l.delay) : "");
  }
  for (std::size_t i = 0; i < drawing.boxes.size(); ++i) {
    const auto& b = drawing.boxes[i];
    const auto& c = layout.box[i];
    const bool round = b.kind == Box::Kind::input || b.kind == Box::Kind::output;
    out += fmt::format(
        "<g class=\"{}\"><title>{}</title><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" rx=\"{}\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text><text class=\"below\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text></g>\n",
        style_of(b.kind), xml_text(b.detail.empty() ? b.name : b.detail), c.x - widths[i] / 2, c.y - kBoxHeight / 2,
        widths[i], kBoxHeight, round ? 14 : 3, c.x, c.y - 3, xml_text(b.name), c.x, c.y + 13, xml_text(b.below));
  }
  return out + "</svg>\n";
}

}  // namespace quell
