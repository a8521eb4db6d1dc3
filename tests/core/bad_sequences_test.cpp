// Every file in tests/bad/sequences, with exactly the messages of the text beside it.
#include "core/sequence/sequence.h"
#include "tests/support/bad_files.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace quell::test {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(QUELL_TEST_SOURCE) / "tests/bad/sequences";

class BadSequence : public testing::TestWithParam<std::string> {};

TEST_P(BadSequence, IsRefusedInTheseWords) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(kFolder);
  Diagnostics diagnostics;
  SequenceRequest request;
  request.path = GetParam() + ".json";
  request.profiles = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/profiles";
  const auto sequence = load_sequence(request, diagnostics);
  std::filesystem::current_path(before);
  EXPECT_FALSE(sequence);
  EXPECT_EQ(diagnostics.format(), expected_messages(kFolder, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Files, BadSequence, testing::ValuesIn(bad_files(kFolder)),
                         [](const auto& i) { return i.param; });

}  // namespace
}  // namespace quell::test
