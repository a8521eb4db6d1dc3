// Outcomes of tests as JUnit's XML, which every CI reads.
#pragma once

#include <string>
#include <vector>

namespace quell {

struct TestOutcome {
  std::string name;
  double seconds = 0;
  std::vector<std::string> failures;  // what it was held to and did not keep
  std::string error;                  // what kept it from being run to its end
  std::vector<std::string> written;   // golden images that it made, which it was not held to
  bool good() const { return failures.empty() && error.empty(); }
};

std::string junit_xml(const std::string& suite, const std::vector<TestOutcome>&);

}  // namespace quell
