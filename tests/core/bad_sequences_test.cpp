// Every file in tests/bad/sequences, with exactly the messages of the text beside it.
#include "core/sequence/sequence.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace quell {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(QUELL_TEST_SOURCE) / "tests/bad/sequences";

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    if (entry.path().extension() == ".json") out.push_back(entry.path().stem().string());
  std::ranges::sort(out);
  return out;
}

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
  std::ifstream file(kFolder / (GetParam() + ".txt"));
  const std::string expected{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(diagnostics.format(), expected);
}

INSTANTIATE_TEST_SUITE_P(Files, BadSequence, testing::ValuesIn(names()), [](const auto& i) { return i.param; });

}  // namespace
}  // namespace quell
