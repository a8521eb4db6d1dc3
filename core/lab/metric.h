// Metrics: graphs that judge an image by a reference, joined to the graph whose output they judge.
#pragma once

#include "core/graph/load.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// What a metric calls the image that it judges. Its other inputs are roles of the sequence: "reference", or
// "reference_a" and "reference_b" for two independent halves of one, "motion", "id" and so on.
inline constexpr std::string_view kJudged = "image";

struct Metric {
  std::string name;          // of its file: "psnr_ldr"
  std::string title, about;  // "PSNR", and the formula with its source
  MetricKey key;
  // Outputs: `value`, one number a frame; `pixels`, where it has that, how many entered it, 0 where a frame has no
  // number, as the first of a temporal metric; and `map`, where it has that, the error of each pixel.
  Graph graph;
};

// Names of installed metrics.
std::vector<std::string> installed_metrics(const std::filesystem::path& graphs);

// The metric of this name in graphs/metrics, or of a file. `roles` is what there is to judge with, the judged image
// under kJudged among it: optional inputs that it does not name are left out, and others are errors. Without it, all
// inputs are taken to be there.
std::optional<Metric> load_metric(const std::string& name, const std::filesystem::path& graphs, Registry&, Diagnostics&,
                                  std::optional<std::map<std::string, int>> roles = std::nullopt,
                                  std::vector<Edit> edits = {});

// Frames before the current one whose references enter the number of a metric, 64 at most, as through a loop; -1 when
// none does, not even the current one's.
int reference_frames_back(const Graph& metric);

// Appends the metric to the graph: it judges output `output`, and the graph reads its other inputs as well. Its outputs
// follow those that are there, as "PREFIX.value" and so on; those of `wanted` that it has not are left out. Throws
// Error(Exit::usage) when types do not fit, or when the output is delayed and the metric looks back as well.
void attach_metric(Graph& graph, int output, const Metric&, const std::string& prefix,
                   const std::vector<std::string>& wanted = {"value", "pixels", "map"});

}  // namespace quell
