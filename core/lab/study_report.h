// report.html of a study that has run, from its results and the images that it wrote.
#pragma once

#include "core/lab/report.h"
#include "core/lab/results.h"
#include "core/lab/trial.h"

#include <filesystem>
#include <string>

namespace quell {

// `folder` holds the images; `timings` is the text of timings.json.
Report study_report(const Study&, const Trial&, const Results&, const std::string& timings,
                    const std::filesystem::path& folder);

}  // namespace quell
