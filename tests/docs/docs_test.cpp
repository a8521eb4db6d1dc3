// The documents speak of what is there: their graphs are good, and their links lead somewhere.
#include <gtest/gtest.h>
#include <unistd.h>
#include "tests/support/paths.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace quell::test {

namespace {

namespace fs = std::filesystem;

const fs::path kSource = QUELL_TEST_SOURCE;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What stands between each `begin` and the `end` that follows it.
std::vector<std::string> between(const std::string& text, const std::string& begin, const std::string& end) {
  std::vector<std::string> found;
  for (std::size_t at = 0; (at = text.find(begin, at)) != text.npos;) {
    at += begin.size();
    const auto stop = text.find(end, at);
    if (stop == text.npos) break;
    found.push_back(text.substr(at, stop - at));
    at = stop;
  }
  return found;
}

// Code holds no links, though lambdas look like some.
std::string without_code(const std::string& text) {
  std::string prose;
  for (std::size_t at = 0, end = 0; end != text.npos; at = end + 4) {
    prose += text.substr(at, text.find("```", at) - at);
    end = text.find("```", at);
    if (end != text.npos) end = text.find("\n```", end);
  }
  return prose;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files{kSource / "README.md"};
  for (const auto& entry : fs::directory_iterator(kSource / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  return files;
}

TEST(Docs, HaveGraphsThatAreGood) {
  const fs::path folder = fs::path(testing::TempDir()) / ("quell_docs_graphs_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::copy(kSource / "graphs", folder, fs::copy_options::recursive);
  int graphs = 0;
  for (const auto& document : documents())
    for (const auto& example : between(text_of(document), "```jsonc\n", "\n```")) {
      if (example.find("\"quell\": 1") == example.npos) continue;
      const auto file = folder / ("example" + std::to_string(graphs++) + ".json");
      std::ofstream(file) << example;
      const std::string command = std::string(QUELL_TEST_PROGRAM) + " check '" + file.string() + "' room";
      EXPECT_EQ(std::system((command + " >/dev/null").c_str()), 0) << document << ": " << command << "\n" << example;
    }
  EXPECT_GE(graphs, 3);
  fs::remove_all(folder);
}

TEST(Docs, HaveLinksThatLeadSomewhere) {
  int links = 0;
  for (const auto& document : documents())
    for (const auto& link : between(without_code(text_of(document)), "](", ")")) {
      if (link.starts_with("http") || link.starts_with("#")) continue;
      ++links;
      const auto target = document.parent_path() / link.substr(0, link.find('#'));
      EXPECT_TRUE(fs::exists(target)) << document << " links to " << link;
    }
  EXPECT_GE(links, 5);
}

}  // namespace

}  // namespace quell::test
