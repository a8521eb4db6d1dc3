// Writes JUnit's XML.
#include "core/lab/junit.h"

#include "core/report/xml.h"

#include <fmt/format.h>

#include <algorithm>

namespace quell {

std::string junit_xml(const std::string& suite, const std::vector<TestOutcome>& outcomes) {
  double seconds = 0;
  for (const auto& o : outcomes) seconds += o.seconds;
  const auto errors = std::ranges::count_if(outcomes, [](const TestOutcome& o) { return !o.error.empty(); });
  const auto failures =
      std::ranges::count_if(outcomes, [](const TestOutcome& o) { return o.error.empty() && !o.failures.empty(); });
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\" time=\"{:.3f}\">\n",
      xml_text(suite), outcomes.size(), failures, errors, seconds);
  for (const auto& o : outcomes) {
    text += fmt::format("    <testcase name=\"{}\" classname=\"{}\" time=\"{:.3f}\"", xml_text(o.name), xml_text(suite),
                        o.seconds);
    if (o.good()) {
      text += "/>\n";
      continue;
    }
    text += ">\n";
    if (!o.error.empty()) text += fmt::format("      <error message=\"{}\"/>\n", xml_text(o.error));
    std::string all;
    for (const auto& f : o.failures) all += (all.empty() ? "" : "\n") + f;
    if (o.error.empty()) text += fmt::format("      <failure message=\"{}\"/>\n", xml_text(all));
    text += "    </testcase>\n";
  }
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace quell
