// A list of names makes one test of each.
#include "tests/support/bad_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace quell::test {

namespace fs = std::filesystem;

std::vector<std::string> bad_files(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

std::string expected_messages(const fs::path& folder, const std::string& name) {
  std::ifstream file(folder / (name + ".txt"), std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_FALSE(text.empty()) << "no messages stand beside " << folder / name;
  return text;
}

}  // namespace quell::test
