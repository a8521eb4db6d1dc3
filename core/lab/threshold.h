// Conditions on metrics under which a comparison or a test has failed: "flip > 0.05", "psnr_ldr.min < 30".
#pragma once

#include "core/lab/summary.h"

#include <optional>
#include <string>
#include <string_view>

namespace quell {

struct Threshold {
  enum class Relation { above, at_least, below, at_most };

  std::string text;       // as it was written
  std::string metric;     // "flip"
  std::string statistic;  // of the frames: mean, median, p95, min or max
  Relation relation;
  double limit;

  double of(const Summary&) const;  // the statistic
  bool met_by(double number) const;
};

// METRIC[.STATISTIC] followed by >, >=, < or <= and a number; without a statistic the mean is meant. Throws
// Error(Exit::usage) that says what is wrong and what could stand there; `where` begins it ("--fail").
Threshold parse_threshold(std::string_view text, std::string_view where);

}  // namespace quell
