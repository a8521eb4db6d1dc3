// Quotas of control groups, in trees made up for the purpose.
#include "core/run/cores.h"

#include "tests/support/scratch.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <fstream>
#include <string>
#include <thread>

namespace quell {
namespace {

namespace fs = std::filesystem;

class Quota : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    const fs::path path = scratch_.path(name);
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  void mounts(const std::string& text) { write("proc/self/mountinfo", text); }
  void groups(const std::string& text) { write("proc/self/cgroup", text); }
  std::optional<int> cores() const { return quota_cores(scratch_.folder()); }

  static constexpr const char* kUnified =
      "22 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw\n"
      "30 22 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";

 private:
  test::Scratch scratch_;
};

TEST_F(Quota, NoneWhereNoneIsSet) {
  EXPECT_EQ(cores(), std::nullopt);  // not even a /proc
  mounts(kUnified);
  groups("0::/user.slice/quell.scope\n");
  EXPECT_EQ(cores(), std::nullopt);  // the files are not there
  write("sys/fs/cgroup/user.slice/quell.scope/cpu.max", "max 100000\n");
  EXPECT_EQ(cores(), std::nullopt);
  write("sys/fs/cgroup/user.slice/quell.scope/cpu.max", "nonsense\n");
  EXPECT_EQ(cores(), std::nullopt);
  write("sys/fs/cgroup/user.slice/quell.scope/cpu.max", "100000 0\n");
  EXPECT_EQ(cores(), std::nullopt);
}

TEST_F(Quota, IsRoundedUp) {
  mounts(kUnified);
  groups("0::/a\n");
  for (const auto& [text, expected] : {std::pair("1000 100000\n", 1),
                                       {"100000 100000\n", 1},
                                       {"100001 100000\n", 2},
                                       {"150000 100000\n", 2},
                                       {"200000 50000\n", 4},
                                       {"9223372036854775807 1\n", 2147483647}}) {
    write("sys/fs/cgroup/a/cpu.max", text);
    EXPECT_EQ(cores(), expected) << text;
  }
}

TEST_F(Quota, IsTheLeastOfAllGroupsAbove) {
  mounts(kUnified);
  groups("0::/a/b/c\n");
  write("sys/fs/cgroup/a/cpu.max", "300000 100000\n");
  write("sys/fs/cgroup/a/b/cpu.max", "max 100000\n");
  write("sys/fs/cgroup/a/b/c/cpu.max", "500000 100000\n");
  EXPECT_EQ(cores(), 3);
  write("sys/fs/cgroup/a/b/c/cpu.max", "200000 100000\n");
  EXPECT_EQ(cores(), 2);
  write("sys/fs/cgroup/cpu.max", "100000 100000\n");
  EXPECT_EQ(cores(), 1);
  write("sys/fs/cgroup/a/other/cpu.max", "1 100000\n");
  write("sys/fs/cpu.max", "1 100000\n");  // above the mount there are no groups
  write("sys/fs/cgroup/cpu.max", "max 100000\n");
  EXPECT_EQ(cores(), 2);
}

TEST_F(Quota, OfVersion1) {
  mounts(
      "32 31 0:29 / /sys/fs/cgroup/cpu,cpuacct rw,relatime - cgroup cgroup rw,cpu,cpuacct\n"
      "35 31 0:32 / /sys/fs/cgroup/cpuset rw,relatime - cgroup cgroup rw,cpuset\n"
      "41 31 0:38 / /sys/fs/cgroup/unified rw,relatime - cgroup2 cgroup2 rw\n");
  groups("9:name=systemd:/jobs\n3:cpuset:/other\n2:cpu,cpuacct:/jobs/one\n0::/jobs\n");
  write("sys/fs/cgroup/cpu,cpuacct/jobs/one/cpu.cfs_quota_us", "-1\n");
  write("sys/fs/cgroup/cpu,cpuacct/jobs/one/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(cores(), std::nullopt);
  write("sys/fs/cgroup/cpu,cpuacct/jobs/cpu.cfs_quota_us", "250000\n");
  write("sys/fs/cgroup/cpu,cpuacct/jobs/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(cores(), 3);
  write("sys/fs/cgroup/cpu,cpuacct/jobs/one/cpu.cfs_quota_us", "50000\n");
  EXPECT_EQ(cores(), 1);
}

// What a container sees: the mount shows its own group as the top, and its own group's name leads from there, or from
// the host's top, or out of what it sees.
TEST_F(Quota, InAContainer) {
  write("sys/fs/cgroup/cpu.max", "400000 100000\n");
  write("sys/fs/cgroup/inner/cpu.max", "200000 100000\n");
  mounts(kUnified);
  groups("0::/\n");
  EXPECT_EQ(cores(), 4);
  groups("0::/../../outside\n");
  EXPECT_EQ(cores(), 4);
  mounts("30 22 0:26 /docker/f00 /sys/fs/cgroup ro,nosuid - cgroup2 cgroup rw\n");
  groups("0::/docker/f00\n");
  EXPECT_EQ(cores(), 4);
  groups("0::/docker/f00/inner\n");
  EXPECT_EQ(cores(), 2);
  groups("0::/docker/f0\n");
  EXPECT_EQ(cores(), 4);
}

TEST(Cores, FollowTheAffinity) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  const int all = usable_cores();
  EXPECT_GE(all, 1);
  EXPECT_LE(all, CPU_COUNT(&before));
  std::thread([&] {  // affinity is a thread's
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int c = 0; c < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++c)
      if (CPU_ISSET(c, &before)) CPU_SET(c, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(usable_cores(), 1);
  })
      .join();
}

}  // namespace
}  // namespace quell
