// Every file in tests/bad/studies, with exactly the messages of the text beside it.
#include "tests/support/bad_files.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace quell::test {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(QUELL_TEST_SOURCE) / "tests/bad/studies";

class BadStudy : public testing::TestWithParam<std::string> {};

TEST_P(BadStudy, IsRefusedInTheseWords) {
  ProgramOptions options;
  options.folder = kFolder.string();
  // Relative, so that messages read the same in every checkout.
  options.environment = {{"QUELL_GRAPHS", "../../../graphs"}, {"QUELL_PLUGINS", QUELL_TEST_PLUGINS}};
  const auto result = run_program({QUELL_TEST_PROGRAM, "ablate", "./" + GetParam() + ".json", "--check"}, options);
  EXPECT_EQ(result.exit, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, expected_messages(kFolder, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Files, BadStudy, testing::ValuesIn(bad_files(kFolder)), [](const auto& i) { return i.param; });

}  // namespace
}  // namespace quell::test
