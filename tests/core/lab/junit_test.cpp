// JUnit's XML of outcomes.
#include "core/lab/junit.h"

#include <gtest/gtest.h>

namespace quell {
namespace {

TEST(Junit, Outcomes) {
  const std::vector<TestOutcome> outcomes = {{"good", 0.5, {}, ""},
                                             {"bad", 0.25, {"flip > 0.05: the mean is 0.06", "frame 7: <\"&\">"}, ""},
                                             {"lost", 0, {}, "no\x01 file"}};
  EXPECT_EQ(junit_xml("All & more", outcomes), R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites>
  <testsuite name="All &amp; more" tests="3" failures="1" errors="1" time="0.750">
    <testcase name="good" classname="All &amp; more" time="0.500"/>
    <testcase name="bad" classname="All &amp; more" time="0.250">
      <failure message="flip &gt; 0.05: the mean is 0.06&#10;frame 7: &lt;&quot;&amp;&quot;&gt;"/>
    </testcase>
    <testcase name="lost" classname="All &amp; more" time="0.000">
      <error message="no? file"/>
    </testcase>
  </testsuite>
</testsuites>
)");
}

}  // namespace
}  // namespace quell
