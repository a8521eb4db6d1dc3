// Runs that are interrupted or killed, and the memory of long ones.
#include "tests/support/quell_command.h"

#include <algorithm>
#include <csignal>
#include <string>

namespace quell::test {
namespace {

class Interrupt : public QuellCommand {
 protected:
  // A run of several outputs that takes longer than any test.
  std::vector<std::string> long_run(const char* spp = "16") {
    return command({"run", "svgf", "room", "--source", "width=160", "--source", "height=90", "--source",
                    std::string("spp=") + spp, "--frames", "0-99999", "--tap", "age", "--preview", "--progress", "json",
                    "-o", "out/c.####.exr"});
  }
  static long frames_done(const Program& program) {
    const auto err = program.err();
    return std::ranges::count(err, '\n');
  }
  // Every file under a final name can be read whole; gives how many there are.
  std::size_t whole_files(bool temporaries_allowed) {
    std::size_t count = 0;
    for (const auto& name : files("out")) {
      if (name.starts_with(".")) {
        EXPECT_TRUE(temporaries_allowed) << name;
        continue;
      }
      EXPECT_NO_THROW(EXPECT_EQ(pixels("out/" + name).width, 160)) << name;
      ++count;
    }
    return count;
  }
};

TEST_F(Interrupt, EndsTheRunWithWholeFrames) {
  for (const auto& [signal, code] : {std::pair(SIGINT, 130), {SIGTERM, 143}}) {
    Program program(long_run(), here());
    ASSERT_TRUE(program.wait_until([&] { return frames_done(program) >= 3; })) << program.err();
    program.send(signal);
    const auto r = program.finish();
    EXPECT_EQ(r.exit, code) << r.err;
    EXPECT_EQ(r.out, "");
    const auto message = r.err.find("quell: interrupted\n  written before: frames 0-");
    ASSERT_NE(message, std::string::npos) << r.err;
    const auto last = std::stoul(r.err.substr(r.err.rfind('-') + 1));
    EXPECT_GE(last, 1u);
    // Two outputs, and a preview of each.
    if (signal == SIGINT) {
      EXPECT_EQ(whole_files(false), 4 * (last + 1));
    }
  }
  whole_files(false);
}

TEST_F(Interrupt, WorksWhileTheFirstFrameIsStillMade) {
  Program program(long_run("1000000"), here({.seconds = 60}));
  ASSERT_TRUE(program.wait_until([&] { return (program.status("SigCgt", 16) >> (SIGINT - 1)) & 1; }));
  program.send(SIGINT);
  const auto r = program.finish();
  EXPECT_EQ(r.exit, 130) << r.err;
  EXPECT_EQ(r.err, "quell: interrupted\n");
  EXPECT_TRUE(files().empty());
}

TEST_F(Interrupt, TwiceLeavesNoHalfFileEither) {
  // A frame is written while the next is filtered, so with two done the first is there.
  for (int done = 2; done <= 4; ++done) {
    Program program(long_run("1"), here());
    ASSERT_TRUE(program.wait_until([&] { return frames_done(program) >= done; })) << program.err();
    program.send(SIGINT);
    program.send(SIGINT);
    const auto r = program.finish();
    EXPECT_EQ(r.exit, 130) << r.err;
    EXPECT_GE(whole_files(false), 1u);
  }
}

TEST_F(Interrupt, AKillLeavesNoHalfFileUnderAFinalName) {
  for (int done = 2; done <= 6; done += 2) {
    Program program(long_run("1"), here());
    ASSERT_TRUE(program.wait_until([&] { return frames_done(program) >= done; })) << program.err();
    program.send(SIGKILL);
    EXPECT_EQ(program.finish().signal, SIGKILL);
    EXPECT_GE(whole_files(true), 1u);
  }
}

TEST_F(Interrupt, LeavesNoState) {
  Program program(long_run("1") + std::vector<std::string>{"--save-state", "a.state"}, here());
  ASSERT_TRUE(program.wait_until([&] { return frames_done(program) >= 2; })) << program.err();
  program.send(SIGINT);
  EXPECT_EQ(program.finish().exit, 130);
  for (const auto& name : files()) EXPECT_TRUE(name.starts_with("out/")) << name;
}

TEST_F(Interrupt, MemoryDoesNotGrowWithTheSequence) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer keeps freed memory";
#endif
  Program program(command({"run", "svgf", "room", "--source", "width=32", "--source", "height=18", "--frames", "0-199",
                           "--threads", "2", "--progress", "json", "-o", "c.####.exr"}),
                  here());
  // What it holds of its own, in KiB, when frame 10 was just done, and the most after that. Pages of libraries do not
  // count: they come as code is first run.
  std::uint64_t early = 0, late = 0;
  program.wait_until([&] {
    if (frames_done(program) < 10) return false;
    const auto held = program.status("RssAnon");
    if (early == 0) early = held;
    late = std::max(late, held);
    return false;
  });
  const auto r = program.finish();
  EXPECT_EQ(r.exit, 0) << r.err;
  ASSERT_GT(early, 1000u);
  EXPECT_LE(late, early + 2048);
}

}  // namespace
}  // namespace quell::test
