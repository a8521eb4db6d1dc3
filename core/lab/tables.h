// Tables for people and papers, made from results: a row a variant, a column a metric.
#pragma once

#include "core/lab/results.h"

#include <string>
#include <vector>

namespace quell {

// Mean ± half the width of its 95 % confidence interval, the best of each column bold, an arrow where better lies.
// `cost_ms`, by variant, is a column more; empty: none. One table a sequence, and one over all where there are several.
std::string table_markdown(const Results&, const std::vector<double>& cost_ms);
// The same for LaTeX with the package booktabs.
std::string table_latex(const Results&, const std::vector<double>& cost_ms);

}  // namespace quell
