// Conditions on metrics under which a comparison or a test has failed: "flip > 0.05", "psnr_ldr.min < 30".
#pragma once

#include "core/lab/summary.h"

#include <optional>
#include <string>
#include <string_view>

namespace quell {

// A number of what a metric says of all frames: "flip.p95".
struct MetricStatistic {
  std::string metric;     // "flip"
  std::string statistic;  // of the frames: mean, median, p95, min or max

  double of(const Summary&) const;
};

// METRIC[.STATISTIC]; without a statistic the mean is meant. Throws Error(Exit::usage) that says what could stand
// there.
MetricStatistic parse_statistic(std::string_view text);

struct Threshold : MetricStatistic {
  enum class Relation { above, at_least, below, at_most };

  std::string text;  // as it was written
  Relation relation;
  double limit;

  bool met_by(double number) const;
};

// METRIC[.STATISTIC] followed by >, >=, < or <= and a number. Throws Error(Exit::usage) that says what is wrong and
// what could stand there; `where` begins it ("--fail").
Threshold parse_threshold(std::string_view text, std::string_view where);

}  // namespace quell
