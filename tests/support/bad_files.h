// A folder of files with mistakes, each NAME.json beside NAME.txt, which holds the messages that it must give.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quell::test {

// Names, in order.
std::vector<std::string> bad_files(const std::filesystem::path& folder);
// The messages that stand beside one.
std::string expected_messages(const std::filesystem::path& folder, const std::string& name);

}  // namespace quell::test
