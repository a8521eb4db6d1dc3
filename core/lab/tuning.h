// A search for parameters: which of a graph's, within what ranges, to make what expression of metrics small on which
// sequences. Parsed from its file.
#pragma once

#include "core/lab/expression.h"
#include "core/lab/search.h"
#include "core/lab/study.h"
#include "core/report/diagnostics.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace quell {

struct TunedParameter {
  std::string name;             // as --set takes it: "alpha", "level0.atrous.step"
  SearchRange range;            // it starts in its middle
  std::optional<double> start;  // none: the graph's own value where the range holds it, else the middle
  TextPosition position;
};

inline constexpr std::size_t kMaxTuned = 100;  // parameters; of many fewer the search still finds its way

struct Tuning {
  std::string file, name, about;
  std::string text;               // of the file
  Study training;                 // the graph and the metrics of the expression; its first variant is the graph itself
  std::optional<Study> held_out;  // the same on sequences that the search does not see
  std::vector<TunedParameter> parameters;
  std::optional<Expression> minimise;
  int evaluations = 60;
  double tolerance = 0.01;  // of each range
};

// All mistakes of the file together; whether parameters and metrics exist is for the graph to say.
std::optional<Tuning> load_tuning(const std::string& path, const std::filesystem::path& graphs, Diagnostics&);

}  // namespace quell
