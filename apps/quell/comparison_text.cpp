// A comparison as a table for the terminal.
#include "apps/quell/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quell {

namespace {

std::string number_text(const Summary& s) {
  if (s.count == 0) return "-";
  if (s.count == 1) return fmt::format("{:.5g}", s.mean);
  return fmt::format("{:.5g} ± {:.2g}", s.mean, s.high - s.mean);
}

// Columns on a terminal: characters, not bytes.
std::size_t width(std::string_view text) {
  return std::size_t(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(std::string text, std::size_t columns, bool right) {
  const std::string space(columns > width(text) ? columns - width(text) : 0, ' ');
  return right ? space + text : text + space;
}

}  // namespace

std::string comparison_text(const Results& r) {
  std::vector<std::vector<std::string>> rows(r.variants.size() + 1);
  rows[0].push_back("");
  for (const auto& v : r.variants) rows[&v - r.variants.data() + 1].push_back(v.name);
  const auto all = summaries(r);
  for (std::size_t m = 0; m < r.metrics.size(); ++m) {
    const auto& metric = r.metrics[m];
    rows[0].push_back(fmt::format("{}{} {} ", metric.name, metric.unit.empty() ? "" : " [" + metric.unit + "]",
                                  metric.higher_is_better ? "↑" : "↓"));
    std::vector<const Summary*> column;
    for (const auto& s : all)
      if (s.metric == m && s.sequence == std::optional<std::size_t>(0)) column.push_back(&s.summary);
    const Summary* best = nullptr;
    for (const auto* s : column)
      if (s->count && (!best || (metric.higher_is_better ? s->mean > best->mean : s->mean < best->mean))) best = s;
    for (std::size_t v = 0; v < column.size(); ++v) {
      const bool marked = column.size() > 1 && best && column[v]->count && column[v]->mean == best->mean;
      rows[v + 1].push_back(number_text(*column[v]) + (marked ? "*" : " "));
    }
  }
  std::vector<std::size_t> columns(rows[0].size());
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) columns[c] = std::max(columns[c], width(row[c]));
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) line += (c ? "  " : "") + padded(row[c], columns[c], c > 0);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace quell
