// Tables for people and papers, made from results: a row a variant, a column a metric.
#pragma once

#include "core/lab/results.h"

#include <string>
#include <vector>

namespace quell {

// Milliseconds of each variant; empty: nothing was timed.
struct Costs {
  std::vector<double> all;                       // over all sequences
  std::vector<std::vector<double>> of_sequence;  // by sequence
};

// Mean ± half the width of its 95 % confidence interval, the best of each column bold, an arrow where better lies.
// One table a sequence, and one over all where there are several. The cost is a column more, without a best: machines
// are busy, and it is no more exact than that.
std::string table_markdown(const Results&, const Costs&);
// The same for LaTeX with the package booktabs.
std::string table_latex(const Results&, const Costs&);

}  // namespace quell
