// Frame ranges and file name patterns.
#include "core/report/error.h"
#include "core/sequence/frame_pattern.h"
#include "core/sequence/frame_range.h"
#include "tests/support/scratch.h"

#include <gtest/gtest.h>

#include <fstream>

namespace quell {
namespace {

using Frames = std::vector<std::int64_t>;

Frames range(std::string_view text) {
  std::string problem;
  const auto frames = parse_frame_range(text, problem);
  EXPECT_TRUE(frames) << problem;
  return frames.value_or(Frames{});
}

std::string refusal(std::string_view text) {
  std::string problem;
  EXPECT_FALSE(parse_frame_range(text, problem)) << text;
  return problem;
}

TEST(FrameRange, TakesTheGrammarOfOpenImageIo) {
  EXPECT_EQ(range("7"), (Frames{7}));
  EXPECT_EQ(range("0-4"), (Frames{0, 1, 2, 3, 4}));
  EXPECT_EQ(range("1-10x3"), (Frames{1, 4, 7, 10}));
  EXPECT_EQ(range("1-10:3"), (Frames{1, 4, 7, 10}));
  EXPECT_EQ(range("1-6y2"), (Frames{2, 4, 6}));
  EXPECT_EQ(range("1,2,5-7"), (Frames{1, 2, 5, 6, 7}));
  EXPECT_EQ(range("1, 2 ,4"), (Frames{1, 2, 4}));
  EXPECT_EQ(range("13-10"), (Frames{13, 12, 11, 10}));
  EXPECT_EQ(range("20-10x5"), (Frames{20, 15, 10}));
  EXPECT_EQ(range("20-10x-5"), (Frames{20, 15, 10}));
  EXPECT_EQ(range("-3--1"), (Frames{-3, -2, -1}));
  EXPECT_EQ(range("-1-1"), (Frames{-1, 0, 1}));
  EXPECT_EQ(range("9,3"), (Frames{9, 3}));
}

TEST(FrameRange, RefusesWithTheOffendingText) {
  const std::string rest = " is no frame range: write a frame, first-last or first-lastxstep, with commas between";
  EXPECT_EQ(refusal("1-x"), "'1-x'" + rest);
  EXPECT_EQ(refusal("1,,2"), "''" + rest);
  EXPECT_EQ(refusal(""), "''" + rest);
  EXPECT_EQ(refusal("5-10x0"), "'5-10x0'" + rest);
  EXPECT_EQ(refusal("1-9x-2"), "'1-9x-2'" + rest);
  EXPECT_EQ(refusal("1-2-3"), "'1-2-3'" + rest);
  EXPECT_EQ(refusal("1.5"), "'1.5'" + rest);
  EXPECT_EQ(refusal("99999999999999999999"), "'99999999999999999999'" + rest);
  EXPECT_EQ(refusal("-9223372036854775808"), "'-9223372036854775808'" + rest);  // has no absolute value
  EXPECT_EQ(refusal("0-999999999999y1"), "'0-999999999999y1' names no frame");  // and that at once
  EXPECT_EQ(refusal("1-5,3"), "'1-5,3' names frame 3 twice");
  EXPECT_EQ(refusal("0-999999999"), "'0-999999999' names more than 10000000 frames");
  EXPECT_EQ(refusal("4-4y1"), "'4-4y1' names no frame");
}

TEST(FrameRange, IsWrittenShortly) {
  EXPECT_EQ(frame_range_text(Frames{1, 2, 3, 7}), "1-3,7");
  EXPECT_EQ(frame_range_text(Frames{-2, -1, 5}), "-2--1,5");
  EXPECT_EQ(frame_range_text({}), "");
}

TEST(FramePattern, ExpandsNumbers) {
  EXPECT_EQ(FramePattern("a.#.exr").path(7), "a.0007.exr");
  EXPECT_EQ(FramePattern("a.##.exr").path(7), "a.07.exr");
  EXPECT_EQ(FramePattern("a.####.exr").path(7), "a.0007.exr");
  EXPECT_EQ(FramePattern("a.####.exr").path(12345), "a.12345.exr");
  EXPECT_EQ(FramePattern("a_@.exr").path(7), "a_7.exr");
  EXPECT_EQ(FramePattern("a_@.exr").path(123), "a_123.exr");
  EXPECT_EQ(FramePattern("a_@@@.exr").path(7), "a_007.exr");
  EXPECT_EQ(FramePattern("a_#@@.exr").path(7), "a_000007.exr");
  EXPECT_EQ(FramePattern("a_%04d.exr").path(7), "a_0007.exr");
  EXPECT_EQ(FramePattern("a_%d.exr").path(7), "a_7.exr");
  EXPECT_EQ(FramePattern("a_####.exr").path(-3), "a_-003.exr");
  EXPECT_EQ(FramePattern("####/a_@.exr").path(7), "####/a_7.exr");
  EXPECT_EQ(FramePattern("####/a.exr").path(7), "0007/a.exr");
  EXPECT_EQ(FramePattern("@/@_@.exr").path(7), "@/7_7.exr");
}

TEST(FramePattern, LeavesOtherNamesAlone) {
  for (const char* name : {"a.exr", "100%.exr", "a%4d.exr", "a%s.exr", "%", "a%99999d.exr"}) {
    EXPECT_FALSE(FramePattern(name).numbered()) << name;
    EXPECT_EQ(FramePattern(name).path(7), name);
  }
}

TEST(FramePattern, FindsFiles) {
  const test::Scratch scratch;
  for (const char* name :
       {"a_0001.exr", "a_0010.exr", "a_12345.exr", "a_2.exr", "a_0003.png", "b_0004.exr", "a_-001.exr", "a_.exr"})
    std::ofstream(scratch.path(name)) << "x";
  EXPECT_EQ(FramePattern(scratch.path("a_####.exr")).scan(), (Frames{-1, 1, 10, 12345}));
  EXPECT_EQ(FramePattern(scratch.path("a_@.exr")).scan(), (Frames{2, 12345}));
  EXPECT_EQ(FramePattern(scratch.path("c_@.exr")).scan(), Frames{});
}

TEST(FramePattern, SaysWhereItLooked) {
  const test::Scratch scratch;
  try {
    FramePattern(scratch.path("none/a_@.exr")).scan();
    FAIL() << "no such folder";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::input);
    EXPECT_EQ(e.what(), "cannot look for '" + scratch.path("none/a_@.exr") + "': " + scratch.path("none") +
                            ": No such file or directory");
  }
}

}  // namespace
}  // namespace quell
