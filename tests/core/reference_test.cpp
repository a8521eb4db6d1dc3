// How wires are written.
#include "core/graph/reference.h"

#include <gtest/gtest.h>

namespace quell {
namespace {

std::string read(std::string_view text) {
  Reference r;
  const auto problem = parse_reference(text, r);
  if (!problem.text.empty()) return problem.text;
  return join_path(r.parts) + " " + std::to_string(r.delay);
}

TEST(Reference, ReadsNamesPortsAndDelays) {
  EXPECT_EQ(read("color"), "color 0");
  EXPECT_EQ(read("blend.image"), "blend.image 0");
  EXPECT_EQ(read("level0.atrous.image@-1"), "level0.atrous.image 1");
  EXPECT_EQ(read("color@-64"), "color 64");
  EXPECT_EQ(read("color@-007"), "color 7");
}

TEST(Reference, RefusesTheRest) {
  for (const char* bad : {"", ".", "a.", ".a", "a..b", "A", "1a", "a b", "a-b", "@-1", "a.@-1", " a", "ä"})
    EXPECT_EQ(read(bad), std::string("'") + bad + "' is no wire");
  for (const char* bad : {"@", "@1", "@+1", "@-", "@-0", "@-65", "@-1x", "@--1", "@-1@-1", "@-99999999999999999999"})
    EXPECT_EQ(read(std::string("a") + bad), std::string("bad delay '") + bad + "'");
}

TEST(Reference, NamesAreSmallLettersDigitsAndUnderscores) {
  EXPECT_TRUE(is_identifier("a"));
  EXPECT_TRUE(is_identifier("level0_x"));
  for (const char* bad : {"", "0a", "_a", "A", "a.b", "a-b", "a b"}) EXPECT_FALSE(is_identifier(bad)) << bad;
}

}  // namespace
}  // namespace quell
