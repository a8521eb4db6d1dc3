// Looks for the parameters that make a number small.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace quell {

struct SearchRange {
  double from, to;       // from < to
  double start;          // in between
  bool log = false;      // steps are factors; from > 0
  bool integer = false;  // rounded before it is tried
};

struct SearchResult {
  std::vector<double> best;
  double value = 0;
  int evaluations = 0;
  bool converged = false;  // rather than out of evaluations
};

// Nelder and Mead's simplex (1965), held to the ranges: no derivatives, nothing random, so that the same function is
// tried at the same points in the same order, which is what lets a search go on after a stop: numbers once found are
// given again. `function` may return NaN or infinity, which count as worse than any number. Ends after `most`
// evaluations or when all of the simplex lies within `tolerance` of each range. Exceptions of `function` pass through.
SearchResult search(std::span<const SearchRange> ranges, int most, double tolerance,
                    const std::function<double(std::span<const double>)>& function);

}  // namespace quell
