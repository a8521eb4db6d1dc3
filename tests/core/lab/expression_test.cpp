// Arithmetic over named numbers: what it comes to, and where it is said to be wrong.
#include "core/lab/expression.h"

#include "tests/support/failure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quell::test {
namespace {

double value(const char* text) {
  return Expression(text)([](const std::string& name) { return name == "a" ? 3.0 : name == "b.p95" ? 5.0 : NAN; });
}

std::string refusal(const std::string& text) {
  return failure(Exit::usage, [&] { Expression parsed(text); });
}

TEST(Expression, Arithmetic) {
  EXPECT_EQ(value("1 + 2 * 3"), 7);
  EXPECT_EQ(value("(1 + 2) * 3"), 9);
  EXPECT_EQ(value("8 / 4 / 2"), 1);
  EXPECT_EQ(value("8 - 4 - 2"), 2);
  EXPECT_EQ(value("-2 - -3"), 1);
  EXPECT_EQ(value("2e2*.5"), 100);
  EXPECT_EQ(value("a - 0.5 * b.p95"), 0.5);
  EXPECT_EQ(value("max(a, b.p95) + min(1,2) + abs(-4) + sqrt(9) + log2(8)"), 5 + 1 + 4 + 3 + 3);
}

TEST(Expression, NamesAreListedOnce) {
  EXPECT_EQ(Expression("a + b.p95 * a").names(), (std::vector<std::string>{"a", "b.p95"}));
}

TEST(Expression, Refusals) {
  EXPECT_EQ(refusal("a +"), "'a +': a number or a name is missing at the end\n  a +\n     ^");
  EXPECT_EQ(refusal("(a"), "'(a': ')' is missing here\n  (a\n    ^");
  EXPECT_EQ(refusal("a b"), "'a b': 'b' is not expected here\n  a b\n    ^");
  EXPECT_EQ(refusal("min(a)"), "'min(a)': ',' is missing here\n  min(a)\n       ^");
  EXPECT_EQ(refusal("sqr(a)"),
            "'sqr(a)': there is no function 'sqr'; there are: abs, sqrt, log2, min, max. Did you mean 'sqrt'?\n"
            "  sqr(a)\n  ^");
  EXPECT_EQ(refusal("a * %"), "'a * %': '%' is not expected here\n  a * %\n      ^");
  EXPECT_NE(refusal(std::string(100000, '(')), "");
  EXPECT_NE(refusal(std::string(100000, '-') + "1"), "");
}

}  // namespace
}  // namespace quell::test
