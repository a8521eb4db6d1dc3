// Runs one test of a suite.
#pragma once

#include "core/lab/junit.h"
#include "core/lab/suite.h"
#include "core/lab/trial.h"
#include "core/run/executor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace quell {

struct SuiteRunOptions {
  RunOptions run;
  bool update_golden = false;      // writes golden images instead of comparing with them; conditions hold as ever
  std::filesystem::path failures;  // where pictures go that fail, with what they should be; "" for nowhere
  std::vector<std::string> command;
  std::string simd;
};

// What keeps the test from its end is an error of its outcome; Error(Exit::interrupted) alone passes through.
TestOutcome run_test(const SuiteTest&, const Trial&, Laboratory&, const SuiteRunOptions&);

}  // namespace quell
