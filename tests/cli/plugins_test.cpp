// Folders of plugins in which something is broken: the rest goes on.
#include "tests/support/paths.h"
#include "tests/support/quell_command.h"

#include <filesystem>

namespace quell::test {
namespace {

namespace fs = std::filesystem;

class Plugins : public QuellCommand {
 protected:
  void SetUp() override {
#ifdef QUELL_TEST_STATIC_PLUGINS
    GTEST_SKIP() << "the plugins are linked into the program";
#endif
    write("plugins/sparkle.so", "this is no library");
    write("plugins/void.so", "");
    write("good.json", R"({"quell": 1, "inputs": {"color": "radiance"},
      "nodes": {"c": {"type": "outlier_clamp", "in": {"image": "color"}}}, "outputs": {"color": "c"}})");
    write("needs.json", R"({"quell": 1, "inputs": {"color": "radiance"},
      "nodes": {"c": {"type": "sparkle", "in": {"image": "color"}}}, "outputs": {"color": "c"}})");
  }
  ProgramResult run(const std::string& graph, const std::vector<std::string>& args, ProgramOptions options = {}) {
    return run_room(graph, std::vector<std::string>{"--quiet"} + args, std::move(options));
  }
};

TEST_F(Plugins, ThatAreBrokenDoNotMatterWhereNobodyNeedsThem) {
  const auto r = run("good.json", {"--plugins", "plugins"});
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(run("good.json", {}, {.environment = {{"QUELL_PLUGINS", "plugins:not/there::"}}}).exit, 0);
}

TEST_F(Plugins, ThatAreNeededAndBrokenEndTheRun) {
  for (const auto& options : {ProgramOptions{}, ProgramOptions{.environment = {{"QUELL_PLUGINS", "plugins"}}}}) {
    const auto r =
        run("needs.json",
            options.environment.empty() ? std::vector<std::string>{"--plugins", "plugins"} : std::vector<std::string>(),
            options);
    EXPECT_EQ(r.exit, 4);
    EXPECT_EQ(
        r.err.find("needs.json:2:31: error: c.type: the plugin of 'sparkle' cannot be used\n  plugins/sparkle.so: "),
        0u)
        << r.err;
    EXPECT_FALSE(fs::exists(path("out")));
  }
  EXPECT_EQ(quell({"check", "needs.json", "--plugins", "plugins"}).exit, 4);
  EXPECT_EQ(quell({"plan", "needs.json", "--plugins", "plugins"}).exit, 4);
  EXPECT_EQ(run("needs.json", {}).exit, 2) << "without the folder there is no such node";
  write("shot.json", R"({"quell_sequence": 1, "frames": "0-1", "source": {"type": "sparkle"}})");
  const auto source = quell({"run", "good.json", "shot.json", "--plugins", "plugins"});
  EXPECT_EQ(source.exit, 4);
  EXPECT_NE(source.err.find("shot.json:1:59: error: source.type: the plugin of 'sparkle' cannot be used"),
            std::string::npos)
      << source.err;
}

TEST_F(Plugins, ThatStandInFrontOfAnotherAreWarnedAbout) {
  write("plugins/outlier_clamp.so", "this is no library");
  const auto r = run("good.json", {"--plugins", "plugins"});
  EXPECT_EQ(r.exit, 0);
  EXPECT_EQ(r.err.find("warning: plugins/outlier_clamp.so: passed over, for it cannot be used\n  "), 0u) << r.err;
}

TEST_F(Plugins, ATypoIsNoPluginError) {
  write("typo.json", R"({"quell": 1, "inputs": {"color": "radiance"},
    "nodes": {"c": {"type": "sparkles", "in": {"image": "color"}}}, "outputs": {"color": "c"}})");
  const auto r = quell({"check", "typo.json", "--plugins", "plugins"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("Did you mean 'sparkle'?"), std::string::npos) << r.err;
}

TEST_F(Plugins, ALibraryIsCalledLikeItsNode) {
  fs::copy_file(fs::path(QUELL_TEST_PLUGINS) / "gaussian.so", path("plugins/sparkle.so"),
                fs::copy_options::overwrite_existing);
  const auto r = quell({"check", "needs.json", "--plugins", "plugins"});
  EXPECT_EQ(r.exit, 4);
  EXPECT_NE(r.err.find("plugins/sparkle.so: holds no node type 'sparkle'"), std::string::npos) << r.err;
}

TEST_F(Plugins, GraphsMayComeFromElsewhere) {
  fs::create_directories(path("graphs/sequences"));
  fs::rename(path("good.json"), path("graphs/mine.json"));
  const ProgramOptions elsewhere{.environment = {{"QUELL_GRAPHS", "graphs"}}};
  EXPECT_EQ(quell({"check", "mine"}, elsewhere).exit, 0);
  const auto r = quell({"check", "svgf"}, elsewhere);
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("installed are: mine"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace quell::test
