// A suite of tests: graphs on sequences, each held to golden images and to conditions on metrics. Parsed from its file.
#pragma once

#include "core/lab/golden.h"
#include "core/lab/study.h"
#include "core/lab/threshold.h"
#include "core/report/diagnostics.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace quell {

struct GoldenImages {
  std::string pattern;  // of its files: "suites/golden/svgf.####.exr"
  std::vector<std::int64_t> frames;
  GoldenTolerance tolerance;
};

struct SuiteTest {
  std::string name;
  TextPosition position;
  Study study;  // its graph on its sequence, judged by the metrics of its conditions; one variant, one sequence
  std::vector<Threshold> fail;
  std::optional<GoldenImages> golden;
};

struct Suite {
  std::string file, name, about;
  std::vector<SuiteTest> tests;
};

// All mistakes of the file together.
std::optional<Suite> load_suite(const std::string& path, const std::filesystem::path& graphs, Diagnostics&);

}  // namespace quell
