// Reads conditions on metrics.
#include "core/lab/threshold.h"

#include "core/report/error.h"
#include "core/report/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace quell {

namespace {

const std::vector<std::string> kStatistics = {"mean", "median", "p95", "min", "max"};

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
  while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
  return s;
}

}  // namespace

double MetricStatistic::of(const Summary& s) const {
  if (statistic == "median") return s.median;
  if (statistic == "p95") return s.p95;
  if (statistic == "min") return s.minimum;
  return statistic == "max" ? s.maximum : s.mean;
}

bool Threshold::met_by(double number) const {
  switch (relation) {
    case Relation::above:
      return number > limit;
    case Relation::at_least:
      return number >= limit;
    case Relation::below:
      return number < limit;
    case Relation::at_most:
      return number <= limit;
  }
  return false;
}

MetricStatistic parse_statistic(std::string_view text) {
  const auto dot = text.find('.');
  MetricStatistic s{std::string(text.substr(0, dot)),
                    dot == std::string_view::npos ? "mean" : std::string(text.substr(dot + 1))};
  if (std::ranges::find(kStatistics, s.statistic) == kStatistics.end())
    throw Error(Exit::usage, fmt::format("there is no statistic '{}'; {}", s.statistic,
                                         possibilities("there are", s.statistic, kStatistics)));
  return s;
}

Threshold parse_threshold(std::string_view text, std::string_view where) {
  const auto refuse = [&](const std::string& why) -> Error {
    return Error(Exit::usage, fmt::format("{} '{}': {}", where, text, why));
  };
  const auto sign = text.find_first_of("<>");
  if (sign == std::string_view::npos)
    throw refuse("expected METRIC[.STATISTIC] > NUMBER or <, >=, <=, as in 'flip > 0.05'");
  Threshold t;
  t.text = text;
  const bool equal = sign + 1 < text.size() && text[sign + 1] == '=';
  if (text[sign] == '>')
    t.relation = equal ? Threshold::Relation::at_least : Threshold::Relation::above;
  else
    t.relation = equal ? Threshold::Relation::at_most : Threshold::Relation::below;

  const auto name = trimmed(text.substr(0, sign));
  if (name.empty() || name.front() == '.') throw refuse("no metric stands before the comparison");
  try {
    static_cast<MetricStatistic&>(t) = parse_statistic(name);
  } catch (const Error& e) {
    throw refuse(e.what());
  }

  const auto number = trimmed(text.substr(sign + (equal ? 2 : 1)));
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), t.limit);
  if (problem != std::errc() || end != number.data() + number.size() || !std::isfinite(t.limit))
    throw refuse(fmt::format("'{}' is not a number", number));
  return t;
}

}  // namespace quell
