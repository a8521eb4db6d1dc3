// Threads and memory of runs over files, and runs that a plugin ends.
#include "tests/support/paths.h"
#include "tests/support/quell_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <time.h>

#include <filesystem>
#include <fstream>

namespace quell::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Resources : public QuellCommand {
 protected:
  // Frames 1 to 200 of radiance, which are one file; each output remembers the frame before.
  void SetUp() override {
    write("shot.json", R"({"quell_sequence": 1, "frames": "1-200", "inputs": {"color": {"file": "in/c.####.exr"}}})");
    write("blur.json", R"({"quell": 1, "inputs": {"color": "radiance"},
      "nodes": {"blur": {"type": "gaussian", "in": {"image": "color"}},
                "clamp": {"type": "outlier_clamp", "in": {"image": "blur"}}},
      "outputs": {"color": "clamp", "before": "blur@-1"}})");
    fs::create_directory(path("in"));
    write_color("in/c.0001.exr", 64, 48, 0.5f);
    for (int f = 2; f <= 200; ++f) fs::create_hard_link(path("in/c.0001.exr"), path(fmt::format("in/c.{:04}.exr", f)));
  }
  std::vector<std::string> args(const std::vector<std::string>& more) {
    return std::vector<std::string>{"run", "blur.json", "shot.json", "-o", "out/c.####.exr"} + more;
  }
  json report(const std::vector<std::string>& more) {
    const auto r = quell(args({"--quiet", "--report", "-"}) + more);
    EXPECT_EQ(r.exit, 0) << r.err;
    return json::parse(r.out);
  }
};

// Libraries may start threads that sleep, so it is counted who works: CPU time, nanoseconds.
double cpu_of_process(pid_t id) {
  clockid_t clock;
  timespec t{};
  if (clock_getcpuclockid(id, &clock) == 0) clock_gettime(clock, &t);
  return 1e9 * double(t.tv_sec) + double(t.tv_nsec);
}
double cpu_of_first_thread(pid_t id) {
  double t = 0;
  std::ifstream(fmt::format("/proc/{}/schedstat", id)) >> t;
  return t;
}

TEST_F(Resources, OneThreadDoesAllWork) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer has a thread of its own";
#endif
  if (!std::ifstream("/proc/self/schedstat")) GTEST_SKIP() << "this kernel does not account for threads";
  Program program(command(args({"--threads", "1", "--quiet"})), here());
  double all = 0, first = 0;
  program.wait_until([&] {
    const double process = cpu_of_process(program.id()), thread = cpu_of_first_thread(program.id());
    if (process > all && thread > first) all = process, first = thread;
    return false;
  });
  const auto r = program.finish();
  EXPECT_EQ(r.exit, 0) << r.err;
  EXPECT_GT(first, 0);
  EXPECT_LT(all - first, 0.1 * first);
}

TEST_F(Resources, MemoryDoesNotDependOnTheNumberOfFrames) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer keeps freed memory";
#endif
  for (const char* threads : {"1", "2"}) {
    const auto few = report({"--threads", threads, "--frames", "1-10"});
    const auto many = report({"--threads", threads});
    EXPECT_EQ(many["frames"], 200);
    EXPECT_EQ(many["image_bytes"], few["image_bytes"]);
    // What one frame more kept would add 190 times: 36 KiB of pixels, or a small part of that of bookkeeping.
    EXPECT_LE(many["peak_bytes"].get<double>(), few["peak_bytes"].get<double>() + 2048 * 1024) << threads;
  }
}

// Down from all frames in flight to none that fits: first the writing of two outputs is given up, then the reading of
// an input.
TEST_F(Resources, FramesInFlightAdaptToTheLimit) {
  const auto all = report({"--threads", "2", "--frames", "1-5", "--float"});
  EXPECT_EQ(all["frames_in_flight"], 3);
  const auto expected = pixels("out/c.0005.exr");
  std::string flights = "3";
  double bytes = all["image_bytes"];
  for (;;) {
    fs::remove_all(path("out"));
    const auto limit = fmt::format("{:.12f}", (bytes - 64) / (1 << 30));
    const auto r = quell(
        args({"--quiet", "--report", "r.json", "--threads", "2", "--frames", "1-5", "--float", "--max-memory", limit}));
    if (r.exit) {
      EXPECT_EQ(r.exit, 5);
      EXPECT_EQ(r.err.find("quell: error: the images of one frame need "), 0u) << r.err;
      EXPECT_NE(r.err.find("\n  blur.image: "), std::string::npos) << r.err;
      EXPECT_TRUE(files("out").empty()) << "refused before the first frame";
      break;
    }
    const auto now = json::parse(read("r.json"));
    EXPECT_LT(now["image_bytes"].get<double>(), bytes);
    bytes = now["image_bytes"];
    const int in_flight = now["frames_in_flight"];
    flights += fmt::format(" {}", in_flight);
    EXPECT_EQ(r.err.find(fmt::format("warning: {} of 3 frames in flight: all would take ", in_flight)), 0u) << r.err;
    EXPECT_EQ(pixels("out/c.0005.exr"), expected);
    ASSERT_LT(flights.size(), 20u);
  }
  EXPECT_EQ(flights, "3 2 1");
}

TEST_F(Resources, APluginThatFailsEndsTheRunAndLeavesWholeFrames) {
#ifdef QUELL_TEST_STATIC_PLUGINS
  GTEST_SKIP() << "the plugins are linked into the program";
#endif
  write("trips.json", R"({"quell": 1, "inputs": {"color": "radiance"},
    "nodes": {"fall": {"type": "trips", "in": {"image": "color"}, "set": {"frame": 7, "row": 21}}},
    "outputs": {"color": "fall"}})");
  for (const char* threads : {"1", "2", "4"}) {
    fs::remove_all(path("out"));
    const auto r = quell({"run", "trips.json", "shot.json", "-o", "out/c.####.exr", "--plugins", QUELL_TEST_TRIPS,
                          "--threads", threads, "--band-rows", "4", "--quiet"});
    EXPECT_EQ(r.exit, 4);
    EXPECT_EQ(r.err,
              "quell: error: fall (trips), frame 7, rows 20-23: row 21 is unlucky\n  written before: frames 1-6\n");
    ASSERT_EQ(files("out").size(), 6u);
    for (int f = 1; f <= 6; ++f) EXPECT_EQ(pixels(fmt::format("out/c.{:04}.exr", f)), pixels("in/c.0001.exr"));
  }
}

}  // namespace
}  // namespace quell::test
