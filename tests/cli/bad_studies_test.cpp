// Every file in tests/bad/studies, with exactly the messages of the text beside it.
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace quell::test {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(QUELL_TEST_SOURCE) / "tests/bad/studies";

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    if (entry.path().extension() == ".json") out.push_back(entry.path().stem().string());
  std::ranges::sort(out);
  return out;
}

class BadStudy : public testing::TestWithParam<std::string> {};

TEST_P(BadStudy, IsRefusedInTheseWords) {
  ProgramOptions options;
  options.folder = kFolder.string();
  // Relative, so that messages read the same in every checkout.
  options.environment = {{"QUELL_GRAPHS", "../../../graphs"}, {"QUELL_PLUGINS", QUELL_TEST_PLUGINS}};
  const auto result = run_program({QUELL_TEST_PROGRAM, "ablate", "./" + GetParam() + ".json", "--check"}, options);
  EXPECT_EQ(result.exit, 2);
  EXPECT_EQ(result.out, "");
  std::ifstream file(kFolder / (GetParam() + ".txt"));
  const std::string expected{std::istreambuf_iterator<char>(file), {}};
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(result.err, expected);
}

INSTANTIATE_TEST_SUITE_P(Files, BadStudy, testing::ValuesIn(names()), [](const auto& i) { return i.param; });

}  // namespace
}  // namespace quell::test
