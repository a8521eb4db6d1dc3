// The same pixels for any number of threads, any bands and any chunks; and on every SIMD target, within a tolerance.
#include "tests/support/quell_command.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace quell::test {
namespace {

namespace fs = std::filesystem;

class SameBits : public QuellCommand {
 protected:
  // All images of a run of svgf over the room, by file.
  std::map<std::string, Pixels> run(const std::vector<std::string>& args, const std::string& frames = "0-3") {
    const auto r = run_room(
        "svgf",
        std::vector<std::string>{"--quiet", "--float", "-o", "c.####.exr", "--tap", "age", "--frames", frames} + args);
    EXPECT_EQ(r.exit, 0) << r.err;
    EXPECT_EQ(r.err, "");
    std::map<std::string, Pixels> all;
    for (const auto& name : files())
      if (name.ends_with(".exr")) {
        all[name] = pixels(name);
        fs::remove(path(name));
      }
    return all;
  }
  ProgramResult room(const std::vector<std::string>& args) { return run_room("svgf", args); }
};

TEST_F(SameBits, ForAnyThreadsAndBands) {
  const auto one = run({"--threads", "1"});
  ASSERT_EQ(one.size(), 8u);
  for (const char* threads : {"2", "4"}) EXPECT_EQ(run({"--threads", threads}), one) << threads << " threads";
  for (const char* rows : {"1", "7", "64", "100000"})
    EXPECT_EQ(run({"--threads", "3", "--band-rows", rows}), one) << rows << " rows";
}

TEST_F(SameBits, InChunks) {
  const auto whole = run({}, "0-5");
  auto joined = run({"--save-state", "a.state"}, "0-2");
  joined.merge(run({"--load-state", "a.state", "--save-state", "a.state"}, "3"));
  auto rest = run({"--load-state", "a.state"}, "4-5");
  EXPECT_NE(run({}, "4-5"), rest) << "without its past it would be another";
  joined.merge(rest);
  EXPECT_EQ(joined, whole);
}

TEST_F(SameBits, AStateIsRefusedWhereItDoesNotFit) {
  run({"--save-state", "a.state"}, "0-2");
  EXPECT_EQ(files(), std::vector<std::string>{"a.state"});
  const auto refused = [&](const std::vector<std::string>& args, const std::string& why) {
    const auto r = room(std::vector<std::string>{"--frames", "3-4"} + args);
    EXPECT_EQ(r.exit, 3) << r.err;
    EXPECT_NE(r.err.find(why), std::string::npos) << why << "\nin\n" << r.err;
    EXPECT_FALSE(fs::exists(path("out")));
  };
  refused({"--load-state", "a.state", "--set", "alpha=0.3"},
          "a.state: cannot load state: it was saved by another graph");
  refused({"--load-state", "a.state", "--frames", "7-8"},
          "it was saved after frame 2, so a run must go on with frame 3, not 7");
  refused({"--load-state", "a.state", "--source", "width=32"}, "was 64x36 with");
  refused({"--load-state", "no.state"}, "no.state: cannot load state: No such file or directory");
  fs::create_directories(path("folder"));
  refused({"--load-state", "folder"}, "folder: cannot load state: it is a folder");
  const auto good = read("a.state");
  write("short.state", good.substr(0, good.size() / 2));
  refused({"--load-state", "short.state"}, "short.state: cannot load state: it ends too early");
  auto flipped = good;
  flipped[good.size() / 2] = char(flipped[good.size() / 2] ^ 4);
  write("flipped.state", flipped);
  refused({"--load-state", "flipped.state"}, "flipped.state: cannot load state: its checksum does not fit");
  write("other.state", "something else");
  refused({"--load-state", "other.state"}, "other.state: cannot load state: this is no state file");
}

struct Target {
  const char* name;
  std::int64_t bit;
};
constexpr Target kTargets[] = {{"scalar", HWY_SCALAR}, {"sse4", HWY_SSE4}, {"avx2", HWY_AVX2}, {"avx512", HWY_AVX3}};

bool present(const Target& target) { return target.bit == HWY_SCALAR || (hwy::SupportedTargets() & target.bit); }

TEST_F(SameBits, OnEachSimdTarget) {
  const auto scalar = run({"--simd", "scalar"});
  for (const auto& target : kTargets) {
    if (!present(target)) continue;
    SCOPED_TRACE(target.name);
    const auto one = run({"--simd", target.name, "--threads", "1"});
    EXPECT_EQ(run({"--simd", target.name, "--threads", "2"}), one);
    ASSERT_EQ(one.size(), scalar.size());
    double worst = 0, largest = 0;
    for (const auto& [file, image] : scalar)
      for (const auto& [channel, plane] : image.channels)
        for (std::size_t p = 0; p < plane.size(); ++p) {
          const double a = plane[p], b = one.at(file).channels.at(channel)[p];
          worst = std::max(worst, std::abs(a - b) / std::max(1.0, std::abs(a)));
          largest = std::max(largest, a);
        }
    EXPECT_GT(largest, 0.1) << "there is something to compare";
    // Steps round to 6e-8; the exponents of weights are sums of up to 100 and amplify that, and history repeats it.
    EXPECT_LT(worst, 1e-4);
    if (target.bit == HWY_AVX2) {
      EXPECT_GT(worst, 0) << "it rounds products and sums once, so another target has run";
    }
  }
}

TEST_F(SameBits, ATargetThatIsNotHereIsRefused) {
  bool all = true;
  for (const auto& target : kTargets) {
    const auto r = room({"--simd", target.name, "--frames", "0", "--quiet", "--report", "-"});
    if (present(target)) {
      EXPECT_EQ(r.exit, 0) << r.err;
      EXPECT_NE(r.out.find(fmt::format("\"simd\": \"{}\"", target.name)), std::string::npos) << r.out;
      continue;
    }
    all = false;
    EXPECT_EQ(r.exit, 5);
    EXPECT_EQ(r.err.find(fmt::format("quell: error: --simd {}: this machine lacks it; it has: ", target.name)), 0u)
        << r.err;
    EXPECT_NE(r.err.find("scalar"), std::string::npos) << r.err;
  }
  if (all) GTEST_SKIP() << "this machine has every target, so none can be refused";
}

}  // namespace
}  // namespace quell::test
