// The key "metric" of a graph file: how the number that the graph gives is to be read.
#pragma once

#include <optional>
#include <string>

namespace quell {

struct MetricKey {
  bool higher_is_better = false;
  std::string unit;               // "" for a bare number
  std::optional<double> perfect;  // what an image gets that is its reference; none: no such number
};

}  // namespace quell
