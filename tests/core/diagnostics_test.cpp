// Places and the look of messages.
#include "core/report/diagnostics.h"

#include <gtest/gtest.h>

namespace quell {
namespace {

TEST(Sources, PlacesCountLinesAndCodePoints) {
  Sources sources;
  const int s = sources.add("a.json", "ab\nä€x\n\nlast");
  EXPECT_EQ(sources.place({s, 0}), "a.json:1:1");
  EXPECT_EQ(sources.place({s, 2}), "a.json:1:3");  // the line's end
  EXPECT_EQ(sources.place({s, 3}), "a.json:2:1");
  EXPECT_EQ(sources.place({s, 8}), "a.json:2:3");  // x behind two code points of two and three bytes
  EXPECT_EQ(sources.place({s, 10}), "a.json:3:1");
  EXPECT_EQ(sources.place({s, 999}), "a.json:4:5");  // behind the end is the end
  EXPECT_EQ(sources.place({}), "");
}

TEST(Sources, OptionsHaveNoLines) {
  Sources sources;
  EXPECT_EQ(sources.place({sources.add("--set #2", "a.b=3"), 2}), "--set #2");
}

TEST(Sources, ByteOrderMarkIsNoColumn) {
  Sources sources;
  const int s = sources.add("a.json", "\xEF\xBB\xBF{}");
  EXPECT_EQ(sources.place({s, 3}), "a.json:1:1");
}

TEST(Diagnostics, LooksLikeACompiler) {
  Diagnostics d;
  const int s = d.sources.add("graphs/svgf.json", "{\n  \"x\": 1\n}");
  d.error({s, 4}, "level0.in.image", "node 'variance' has no output 'colour'",
          {"it has: image, variance. Did you mean 'image'?"});
  EXPECT_EQ(d.format(),
            "graphs/svgf.json:2:3: error: level0.in.image: node 'variance' has no output 'colour'\n"
            "  it has: image, variance. Did you mean 'image'?\n");
}

TEST(Diagnostics, SortsByPlaceAndDropsDoubles) {
  Diagnostics d;
  const int s = d.sources.add("a", "12345"), o = d.sources.add("--set #1", "x=y");
  d.error({o, 0}, "", "third");
  d.error({s, 3}, "", "second");
  d.warning({s, 1}, "p", "first");
  d.error({s, 3}, "", "second");
  d.error({}, "", "nowhere");
  EXPECT_EQ(d.format(), "error: nowhere\na:1:2: warning: p: first\na:1:4: error: second\n--set #1: error: third\n");
  EXPECT_EQ(d.errors(), 4u);
  EXPECT_FALSE(d.ok());
}

TEST(Diagnostics, ShowsControlBytesInPlaceOfObeyingThem) {
  Diagnostics d;
  d.error({}, "nodes.\x1b[31mx", "node '\x1b[31mx\x7f' is\tred", {"note\x07"});
  EXPECT_EQ(d.format(), "error: nodes.\\x1b[31mx: node '\\x1b[31mx\\x7f' is\\x09red\n  note\\x07\n");
}

}  // namespace
}  // namespace quell
