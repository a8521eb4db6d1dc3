// The variants of a study, its sweeps and automatic ablations among them.
#pragma once

#include "core/lab/study.h"

namespace quell {

// The graph itself first, as "base"; then "variants", "leave_one_out", "each_feedback_level", "sweeps" (crossed),
// "sweep_separately" and "baselines". `folder` is the study's: graph files are named from there. Reports two variants
// of one name, empty sweeps and more than kMaxVariants.
std::vector<StudyVariant> expand_variants(const Json& study, const std::string& graph,
                                          const std::filesystem::path& folder, Diagnostics&);

// What load_graph takes for a graph that a file in `folder` names: installed ones go by name, others lie beside it.
std::string graph_file(const std::string& graph, const std::filesystem::path& folder);

// What keeps a name from being that of a file and a folder in results; "" when nothing does.
std::string problem_of_name(const std::string& name);

}  // namespace quell
