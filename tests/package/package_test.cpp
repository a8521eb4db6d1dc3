// Plugins that were built out of tree, by the C++ SDK and in plain C, load and run, in a program that was installed and
// moved.
#include "core/plugin/registry.h"
#include "tests/support/read_channels.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace quell::test {

namespace {

const std::filesystem::path kWork = QUELL_TEST_PACKAGE;

TEST(Package, InstallsWhatAuthorsNeed) {
  for (const char* file : {"bin/quell", "include/quell/abi.h", "include/quell/node.h", "share/quell/graphs"})
    EXPECT_TRUE(std::filesystem::exists(kWork / "prefix" / file)) << file;
}

// Gives the node one image of 5×2 whose numbers are x + 10 y.
Image applied(const char* name) {
  static Registry registry({kWork / "build"});
  const auto* type = registry.find(name);
  if (!type) {
    ADD_FAILURE() << (registry.problem(name) ? registry.problem(name)->text : "not found");
    return Image(5, 2, 1);
  }
  Image in(5, 2, 1), out(5, 2, 1);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 5; ++x) in.at(0, x, y) = float(x + 10 * y);
  const Instance instance(*type);
  const auto in_view = in.view(), out_view = out.view();
  const quell_input input{&in_view, nullptr, 1};
  const quell_tile tile{&input, &out_view, 0, 0, 5, 2, 1};
  quell_error error{};
  EXPECT_EQ(type->table().run(instance.data(), nullptr, &tile, &error), 0) << error.text;
  return out;
}

TEST(Package, RunsANodeOfTheSdk) {
  const auto out = applied("darken");
  EXPECT_EQ(out.at(0, 4, 0), 2.0f);
  EXPECT_EQ(out.at(0, 3, 1), 6.5f);
}

TEST(Package, RunsANodeInPlainC) {
  const auto out = applied("negate");
  EXPECT_EQ(out.at(0, 4, 0), -4.0f);
  EXPECT_EQ(out.at(0, 3, 1), -13.0f);
}

TEST(Package, RunsInAGraphOfTheInstalledProgram) {
  const auto read = [](const char* name, const std::vector<std::string>& channels) {
    return read_channels((kWork / "out" / (std::string(name) + ".0003.exr")).string(), channels);
  };
  const auto image = read("image", {"R", "G", "B"}), darker = read("darker", {"R", "G", "B"});
  const auto depth = read("depth", {"Z"}), negative = read("negative", {"Y"});
  ASSERT_EQ(image.width(), 48);
  ASSERT_EQ(image.height(), 32);
  double sum = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 48; ++x) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(darker.at(c, x, y), image.at(c, x, y) * 0.5f) << x << " " << y;
        sum += image.at(c, x, y);
      }
      ASSERT_EQ(negative.at(0, x, y), -2 * depth.at(0, x, y)) << x << " " << y;
    }
  EXPECT_GT(sum, 0.0);
}

}  // namespace

}  // namespace quell::test
