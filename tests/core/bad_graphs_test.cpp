// Every graph in tests/bad/graphs, with the exact messages that stand beside it. A graph may begin with comments that
// say how it is loaded: "// --set node.parameter=3" and "// roles: color albedo".
#include "tests/support/bad_files.h"
#include "tests/support/graph_nodes.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace quell::test {
namespace {

namespace fs = std::filesystem;

// Relative, so that messages read the same in every checkout.
const fs::path kFolder = "tests/bad/graphs";

GraphRequest request_for(const fs::path& file) {
  GraphRequest request;
  request.graph = file.generic_string();
  request.graphs = kFolder;
  std::ifstream lines(file, std::ios::binary);
  const auto option = [&](const std::string& line, std::string_view name, Edit::Kind kind) {
    if (line.starts_with(name)) request.edits.push_back({kind, line.substr(name.size())});
  };
  for (std::string line; std::getline(lines, line) && line.starts_with("// ");) {
    option(line, "// --set ", Edit::Kind::set);
    option(line, "// --swap ", Edit::Kind::swap);
    option(line, "// --wire ", Edit::Kind::wire);
    option(line, "// --bypass ", Edit::Kind::bypass);
    option(line, "// --tap ", Edit::Kind::tap);
    if (!line.starts_with("// roles: ")) continue;
    request.roles = Roles{};
    std::istringstream roles(line.substr(10));
    for (std::string role; roles >> role;) (*request.roles)[role] = conventional_role(role);
  }
  return request;
}

class BadGraph : public testing::TestWithParam<std::string> {
 protected:
  BadGraph() : before_(fs::current_path()) { fs::current_path(QUELL_TEST_SOURCE); }
  ~BadGraph() override { fs::current_path(before_); }

 private:
  fs::path before_;
};

TEST_P(BadGraph, SaysExactly) {
  const fs::path file = kFolder / (GetParam() + ".json");
  const auto loaded = load(request_for(file));
  const auto expected = expected_messages(kFolder, GetParam());
  EXPECT_EQ(loaded.messages, expected);
  EXPECT_EQ(loaded.graph.has_value(), expected.find("error: ") == expected.npos);
}

INSTANTIATE_TEST_SUITE_P(Files, BadGraph, testing::ValuesIn(bad_files(QUELL_TEST_SOURCE / kFolder)),
                         [](const auto& i) { return i.param; });

}  // namespace
}  // namespace quell::test
