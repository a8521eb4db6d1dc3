// The metrics of a comparison: which are wanted, and which of them what is there to judge by serves.
#pragma once

#include "apps/quell/command.h"

#include "core/lab/metric.h"
#include "core/lab/threshold.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace quell {

struct WantedMetric {
  std::string name;  // or its file
  bool asked;        // false: one of the usual ones, left out where what it reads is not there
};
// Those that are named, or the usual ones, and those of the conditions.
std::vector<WantedMetric> wanted_metrics(const std::vector<std::string>& named, const std::vector<Threshold>&);

// All that they could read of a sequence.
std::set<std::string> roles_of(Commander&, const std::vector<WantedMetric>&);

struct Judge {
  Metric metric;
  std::vector<std::string> lacking;  // what it reads where it is there, and is not
  int back;                          // frames before the current one whose references it needs; -1: it needs none
};
// `roles` is what there is to judge by. What is wrong goes to the diagnostics; throws Error(Exit::usage) when that
// leaves nothing to judge by.
std::vector<Judge> load_judges(Commander&, const std::vector<WantedMetric>&, std::map<std::string, int> roles);

// Where `e`, of a run's first frame, says that a node refuses which is a metric's and called with this prefix: throws
// Error(Exit::usage) that says what the metric lacks, for no plugin is at fault then.
void explain(const Error& e, const std::string& prefix, const std::vector<Judge>&);

}  // namespace quell
