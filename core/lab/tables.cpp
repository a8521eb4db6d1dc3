// One table, twice written.
#include "core/lab/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace quell {

namespace {

constexpr const char* kHow =
    "Mean and 95 % confidence interval (Student's t) over the frames behind the warm-up and all seeds.";

struct Cell {
  bool there = false, best = false;
  double mean = 0, half = 0;
};

struct Column {
  std::string title, unit;
  bool higher = false;
  int decimals = 0;
  std::vector<Cell> cells;  // by variant
};

struct Table {
  std::string caption;
  std::optional<std::size_t> sequence;  // none: over all
  std::vector<Column> columns;
};

// So many that the middle one of the intervals shows two digits; four digits of the largest where there are none.
int decimals_of(const std::vector<Cell>& cells) {
  std::vector<double> halves;
  double most = 0;
  for (const auto& c : cells) {
    if (c.there && c.half > 0) halves.push_back(c.half);
    if (c.there) most = std::max(most, std::abs(c.mean));
  }
  const auto digits = [](double number, int wanted) {
    return std::clamp(wanted - 1 - int(std::floor(std::log10(number))), 0, 9);
  };
  if (halves.empty()) return most > 0 ? digits(most, 4) : 0;
  std::ranges::sort(halves);
  return digits(halves[halves.size() / 2], 2);
}

Column cost_column(const std::vector<double>& cost_ms) {
  Column column{"cost", "ms", false, 1, {}};
  for (const double cost : cost_ms) column.cells.push_back({true, false, cost, 0});
  return column;
}

std::vector<Table> tables(const Results& r, const Costs& costs) {
  std::vector<Table> all;
  for (const auto& s : summaries(r)) {
    if (s.variant == 0 && s.metric == 0)
      all.push_back({s.sequence ? r.sequences[*s.sequence].name : std::string("all sequences"), s.sequence,
                     std::vector<Column>(r.metrics.size())});
    const auto& metric = r.metrics[s.metric];
    auto& column = all.back().columns[s.metric];
    column.title = metric.title.empty() ? metric.name : metric.title;
    column.unit = metric.unit, column.higher = metric.higher_is_better;
    column.cells.push_back({s.summary.count > 0, false, s.summary.mean, (s.summary.high - s.summary.low) / 2});
  }
  for (auto& table : all) {
    for (auto& column : table.columns) column.decimals = decimals_of(column.cells);
    for (auto& column : table.columns) {
      const auto shown = [&](const Cell& c) {
        const double sign = column.higher ? -1 : 1, digits = std::pow(10, column.decimals);
        return sign * std::round(c.mean * digits);
      };
      // What reads the same is equally good.
      double best = HUGE_VAL;
      for (const auto& c : column.cells)
        if (c.there) best = std::min(best, shown(c));
      for (auto& c : column.cells) c.best = c.there && shown(c) == best;
    }
    if (!costs.all.empty())
      table.columns.push_back(cost_column(table.sequence ? costs.of_sequence[*table.sequence] : costs.all));
  }
  // The table over all sequences is the one to read first.
  if (r.sequences.size() > 1) std::rotate(all.begin(), all.end() - 1, all.end());
  return all;
}

std::string latex(const std::string& text) {
  static const std::map<char, std::string> kSpecial = {{'_', "\\_"},
                                                       {'%', "\\%"},
                                                       {'&', "\\&"},
                                                       {'#', "\\#"},
                                                       {'$', "\\$"},
                                                       {'{', "\\{"},
                                                       {'}', "\\}"},
                                                       {'~', "\\textasciitilde{}"},
                                                       {'^', "\\textasciicircum{}"},
                                                       {'\\', "\\textbackslash{}"},
                                                       {'<', "\\textless{}"},
                                                       {'>', "\\textgreater{}"},
                                                       {'|', "\\textbar{}"}};
  std::string out;
  for (const char c : text)
    if (const auto it = kSpecial.find(c); it != kSpecial.end())
      out += it->second;
    else
      out += c;
  return out;
}

std::string markdown(const std::string& text) {
  static const std::string kSpecial = "|\\*_<>`[]#";
  std::string out;
  for (const char c : text) out += kSpecial.find(c) == kSpecial.npos ? std::string(1, c) : std::string{'\\', c};
  return out;
}

std::string number(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

}  // namespace

std::string table_markdown(const Results& r, const Costs& costs) {
  std::string text = fmt::format("# {}\n\n", markdown(r.name));
  if (!r.about.empty()) text += markdown(r.about) + "\n\n";
  text += fmt::format("{}{}\n", kHow, costs.all.empty() ? "" : " Cost: of all threads, a frame, as if run alone.");
  for (const auto& table : tables(r, costs)) {
    text += fmt::format("\n## {}\n\n| variant |", markdown(table.caption));
    for (const auto& c : table.columns)
      text += fmt::format(" {}{} {} |", markdown(c.title), c.unit.empty() ? "" : fmt::format(" [{}]", markdown(c.unit)),
                          c.higher ? "↑" : "↓");
    text += "\n|---|";
    for (std::size_t c = 0; c < table.columns.size(); ++c) text += "---:|";
    text += "\n";
    for (std::size_t v = 0; v < r.variants.size(); ++v) {
      text += fmt::format("| {} |", markdown(r.variants[v].name));
      for (const auto& c : table.columns) {
        const auto& cell = c.cells[v];
        std::string shown = cell.there ? number(cell.mean, c.decimals) : "–";
        if (cell.best) shown = "**" + shown + "**";
        if (cell.there && cell.half > 0) shown += " ± " + number(cell.half, c.decimals);
        text += " " + shown + " |";
      }
      text += "\n";
    }
  }
  return text;
}

std::string table_latex(const Results& r, const Costs& costs) {
  std::string text = fmt::format("% {}. Needs \\usepackage{{booktabs}}.\n", latex(r.name));
  for (const auto& table : tables(r, costs)) {
    text += fmt::format(
        "\\begin{{table}}\n  \\centering\n  \\caption{{{}: {}. {}{}}}\n  \\begin{{tabular}}{{l{}}}\n    "
        "\\toprule\n    Variant",
        latex(r.name), latex(table.caption), latex(kHow),
        costs.all.empty() ? "" : " Cost: of all threads, a frame, as if run alone.",
        std::string(table.columns.size(), 'r'));
    for (const auto& c : table.columns)
      text += fmt::format(" & {}{} ${}$", latex(c.title), c.unit.empty() ? "" : fmt::format(" [{}]", latex(c.unit)),
                          c.higher ? "\\uparrow" : "\\downarrow");
    text += " \\\\\n    \\midrule\n";
    for (std::size_t v = 0; v < r.variants.size(); ++v) {
      text += "    " + latex(r.variants[v].name);
      for (const auto& c : table.columns) {
        const auto& cell = c.cells[v];
        std::string shown = cell.there ? number(cell.mean, c.decimals) : "--";
        if (cell.best) shown = "\\textbf{" + shown + "}";
        if (cell.there && cell.half > 0) shown += " $\\pm$ " + number(cell.half, c.decimals);
        text += " & " + shown;
      }
      text += " \\\\\n";
    }
    text += "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
  }
  return text;
}

}  // namespace quell
