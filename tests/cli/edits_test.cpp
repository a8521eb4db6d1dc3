// --set, --swap, --wire, --bypass and --tap: what they do, and what they refuse.
#include "tests/support/quell_command.h"

namespace quell::test {
namespace {

class Edits : public QuellCommand {
 protected:
  Pixels last(const std::vector<std::string>& edits) {
    const auto r = run_room("svgf", std::vector<std::string>{"--quiet", "--float", "-o", "c.####.exr"} + edits);
    EXPECT_EQ(r.exit, 0) << r.err;
    return pixels("c.0003.exr");
  }
  void refuses(const std::vector<std::string>& edits, const std::vector<std::string>& says) {
    const auto r = run_room("svgf", edits);
    EXPECT_EQ(r.exit, 2) << r.err;
    for (const auto& part : says) EXPECT_NE(r.err.find(part), std::string::npos) << part << "\nin\n" << r.err;
    EXPECT_TRUE(files().empty());
  }
};

TEST_F(Edits, EachChangesTheResult) {
  const auto plain = last({});
  EXPECT_EQ(last({}), plain);
  EXPECT_EQ(last({"--set", "alpha=0.1"}), plain) << "the graph's own value";
  for (const auto& edit : std::vector<std::vector<std::string>>{{"--set", "alpha=0.5"},
                                                                {"--set", "level0.atrous.step=2"},
                                                                {"--set", "demodulation=classic"},
                                                                {"--swap", "by_normal=plane_weight"},
                                                                {"--wire", "history.image=level1.image@-1"},
                                                                {"--wire", "level0.weights=by_normal"},
                                                                {"--bypass", "level3.atrous"}})
    EXPECT_NE(last(edit), plain) << edit[0] << ' ' << edit[1];
  EXPECT_EQ(last({"--set", "alpha=0.5", "--set", "alpha=0.1"}), plain) << "the last counts";
}

TEST_F(Edits, ATapWritesABufferBesideTheOutput) {
  const auto plain = last({});
  EXPECT_EQ(last({"--tap", "blend.image", "--tap", "age", "-o", "age=deep/age.####.exr"}), plain);
  EXPECT_EQ(pixels("blend.image.0003.exr").channels.size(), 3u);
  const auto age = pixels("deep/age.0003.exr");
  ASSERT_EQ(age.channels.size(), 1u);
  for (const float v : age.channels.begin()->second) {
    ASSERT_GE(v, 0.0f);
    ASSERT_LE(v, 4.0f);
  }
}

TEST_F(Edits, MistakesNameWhatIsPossible) {
  refuses({"--set", "alpah=0.1"}, {"--set #1: error: the graph has no parameter 'alpah'", "Did you mean 'alpha'?"});
  refuses({"--set", "alpha=7"}, {"--set #1: error: ", "7 is not a number from 0 to 1", "Weight of this frame"});
  refuses({"--set", "blend.alhpa=0.1"},
          {"node type 'temporal_blend' has no parameter 'alhpa'", "Did you mean 'alpha'?"});
  refuses({"--set", "alpha"}, {"--set #1: error: 'alpha' has no '='", "as in --set level0.atrous.step=2"});
  refuses({"--swap", "by_normal=plan_weight"},
          {"--swap #1: error: ", "there is no node type 'plan_weight'", "'plane_weight'"});
  refuses({"--swap", "nobody=plane_weight"}, {"--swap #1: error: there is no node 'nobody'"});
  refuses({"--wire", "history.image=level9.image@-1"}, {"--wire #1: error: ", "there is no", "'level9'"});
  refuses({"--wire", "history.image=depth@-1", "--wire", "blend.current=depth"},
          {"blend", "is depth, but 'image' takes radiance"});
  refuses({"--bypass", "blned"}, {"--bypass #1: error: there is no node 'blned'", "Did you mean 'blend'?"});
  refuses({"--tap", "blend.iamge"}, {"--tap #1: error: ", "has no output 'iamge'", "Did you mean 'image'?"});
  refuses({"--set", "alpah=1", "--swap", "x=y", "--bypass", "no"}, {"--set #1", "--swap #1", "--bypass #1"});
}

}  // namespace
}  // namespace quell::test
