// A comparison of pictures by metrics: what is read, judged and found.
#pragma once

#include "apps/quell/pictures.h"

#include "core/lab/results.h"
#include "core/lab/threshold.h"
#include "core/run/executor.h"

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace quell {

struct ComparisonRequest {
  std::vector<Pictures> pictures;
  std::string reference, sequence;    // "": none
  std::vector<std::string> metrics;   // empty: the usual ones that can be had
  std::vector<Threshold> thresholds;  // whose metrics are wanted as well
  std::string frames, root, maps;
  std::string references;            // folder where references are kept that a source node makes; "": none are
  std::vector<std::string> written;  // files that will be written of the results, which must not be among those read
  std::function<void(const std::string&)> warn;
  int warm_up = 0, threads = 0;
  const std::atomic<bool>* cancel = nullptr;
};

// The pictures are the variants of the results, "pictures" their one sequence. Gives nothing when there are mistakes,
// which are with the commander then. Throws Error.
std::optional<Results> run_comparison(Commander&, const ComparisonRequest&,
                                      const std::function<void(const Progress&)>& progress);

// A row for each of the pictures and a column for each metric: means, with the 95 % confidence interval over frames
// where there are several, and a * at the best.
std::string comparison_text(const Results&);

}  // namespace quell
