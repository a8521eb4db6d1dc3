// Loading of plugin libraries: what is right is found, what is wrong is refused with its reason, and the rest goes on.
#include "core/plugin/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace quell {

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const fs::path kFolder = QUELL_TEST_LOADER;

std::string problem(const Registry& registry, const char* stem) {
  const auto* p = registry.problem(stem);
  return p ? p->text : "";
}

// The problem of a library that holds the node of its name.
std::string refusal(const char* name) {
  Registry registry({kFolder});
  EXPECT_EQ(registry.find(name), nullptr);
  EXPECT_EQ(registry.problems().size(), 1u);
  return problem(registry, name);
}

TEST(Registry, FindsANodeByTheNameOfItsFile) {
  Registry registry({kFolder});
  const auto* type = registry.find("negate");
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(type->name(), "negate");
  EXPECT_EQ(type->version(), "1.0");
  EXPECT_EQ(type->file(), kFolder / "negate.so");
  EXPECT_EQ(registry.find("negate"), type);
  EXPECT_TRUE(registry.problems().empty()) << "no other library is opened";
}

TEST(Registry, RefusesOtherVersionsOfTheBoundary) {
  EXPECT_EQ(refusal("old_major"), "built for plugin ABI 0.0, this program has 1.0: rebuild the plugin");
  EXPECT_EQ(refusal("new_major"), "built for plugin ABI 2.0, this program has 1.0: rebuild the plugin");
  EXPECT_EQ(refusal("new_minor"), "built for plugin ABI 1.1, this program has 1.0: rebuild the plugin");
}

TEST(Registry, RefusesBrokenTables) {
  EXPECT_EQ(refusal("bad_magic"), "the table's magic number is 0x12345678, expected 0x4c4c4551");
  EXPECT_EQ(refusal("broken_table"), "node 'broken_table': has no summary");
}

TEST(Registry, RefusesWhatIsNoPlugin) {
  EXPECT_EQ(refusal("no_symbol"), "exports no function quell_plugin: not a Quell plugin");
  EXPECT_EQ(refusal("not_a_library"), "file too short");
  EXPECT_EQ(refusal("unresolved"), "undefined symbol: nobody_defines_this");
}

TEST(Registry, NamesBothFilesOfANodeThatIsThereTwice) {
  Registry registry({kFolder});
  registry.all();
  EXPECT_EQ(problem(registry, "twin"),
            "node type 'negate' is already registered by " + (kFolder / "negate.so").string());
  const auto* type = registry.find("negate");
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(type->file(), kFolder / "negate.so");
}

TEST(Registry, GoesOnAfterWhatItRefused) {
  Registry registry({kFolder});
  const auto types = registry.all();
  ASSERT_EQ(types.size(), 1u);
  EXPECT_EQ(types[0]->name(), "negate");
  std::vector<std::string> refused;
  for (const auto& p : registry.problems()) refused.push_back(p.file.stem().string());
  EXPECT_THAT(refused, ElementsAre("bad_magic", "broken_table", "new_major", "new_minor", "no_symbol", "not_a_library",
                                   "old_major", "twin", "unresolved"));
  registry.all();
  EXPECT_EQ(registry.problems().size(), refused.size()) << "each library is opened once";
}

TEST(Registry, SearchesFoldersInOrder) {
  Registry registry({kFolder / "there_is_no_such_folder", kFolder});
  EXPECT_NE(registry.find("negate"), nullptr);
  EXPECT_TRUE(registry.problems().empty());
}

TEST(Registry, TakesNoPathForAName) {
  Registry registry({kFolder / "below"});
  for (const char* name : {"../negate", "/negate", "negate.so", "", "Negate", "neg ate"})
    EXPECT_EQ(registry.find(name), nullptr) << name;
}

TEST(Registry, ListsNamesWithoutOpening) {
  Registry registry({kFolder});
  EXPECT_THAT(registry.names(), ElementsAre("bad_magic", "broken_table", "negate", "new_major", "new_minor",
                                            "no_symbol", "not_a_library", "old_major", "twin", "unresolved"));
  EXPECT_TRUE(registry.problems().empty());
}

TEST(Registry, KeepsWhatIsLinkedIntoTheProgramBeforeFiles) {
  Registry files({kFolder});
  const auto* from_file = files.find("negate");
  ASSERT_NE(from_file, nullptr);

  Registry registry({kFolder});
  registry.add_static(&from_file->plugin());
  const auto* type = registry.find("negate");
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(type->file(), "");
  registry.all();
  EXPECT_EQ(problem(registry, "negate"), "node type 'negate' is already registered by the program itself");
}

TEST(Registry, MakesInstancesThatOwnTheirValues) {
  Registry registry({kFolder});
  const auto* type = registry.find("negate");
  ASSERT_NE(type, nullptr);
  Instance a(*type);
  EXPECT_EQ(a.get_float(0), 1.0f);
  a.set_float(0, 2.5f);
  const Instance b = a;
  a.set_float(0, 3.0f);
  EXPECT_EQ(b.get_float(0), 2.5f);
  EXPECT_EQ(a.describe(), "factor=3");
  EXPECT_EQ(type->find_param("factor"), 0);
  EXPECT_EQ(type->find_param("nothing"), -1);
  ASSERT_EQ(a.reach().size(), 1u);
  EXPECT_EQ(a.reach()[0].left, 0);
}

}  // namespace

}  // namespace quell
