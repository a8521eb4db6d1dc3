// Which threads a run uses, and how many at once.
#include "core/plugin/registry.h"
#include "core/run/executor.h"
#include "tests/support/add_type.h"

#include <gtest/gtest.h>
#include <quell/node.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

namespace quell::test {
namespace {

// Threads that were at work, and the most at once.
class Attendance {
 public:
  class Here {
   public:
    explicit Here(Attendance& all) : all_(all) {
      const std::scoped_lock lock(all_.mutex_);
      all_.threads_.insert(std::this_thread::get_id());
      all_.most_ = std::max(all_.most_, ++all_.now_);
      all_.came_.notify_all();
    }
    ~Here() {
      const std::scoped_lock lock(all_.mutex_);
      --all_.now_;
    }
    Here(const Here&) = delete;
    Here& operator=(const Here&) = delete;

   private:
    Attendance& all_;
  };
  // `company`: whether more than one thread is expected.
  void clear(bool company) { threads_.clear(), most_ = 0, awaited_ = company; }
  // Until two have been here at once, however busy the machine is; where nobody comes, one wait is enough.
  void await_company() {
    std::unique_lock lock(mutex_);
    if (awaited_) awaited_ = came_.wait_for(lock, std::chrono::seconds(20), [this] { return most_ > 1; });
  }
  const std::set<std::thread::id>& threads() const { return threads_; }
  int most() const { return most_; }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::set<std::thread::id> threads_;
  int now_ = 0, most_ = 0;
  bool awaited_ = false;
};

Attendance filtering, all;

struct Attends {
  In<Scalar> image;
  Out<Scalar> out;
  void describe(Describe& d) {
    d.summary("Notes who runs it.");
    d.in(image, "image", "A.");
    d.out(out, "image", "A.");
  }
  void run(const Tile& t) const {
    const Attendance::Here here(filtering), too(all);
    filtering.await_company();
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    for (int y = t.y0; y < t.y1; ++y) std::copy_n(t.row(image, 0, y) + t.x0, t.x1 - t.x0, t.row(out, 0, y) + t.x0);
  }
};

class Frames : public FrameSource {
 public:
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t f) const override { return f == 1; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string>) override { return {{8, 64, 1}}; }
  void read(std::int64_t frame, std::span<const std::string>, std::span<const quell_image> into) override {
    const Attendance::Here here(all);
    for (int y = 0; y < 64; ++y) std::fill_n(into[0].plane[0] + y * into[0].pitch, 8, float(frame));
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

 private:
  std::vector<std::int64_t> frames_{1, 2, 3, 4, 5, 6};
  std::map<std::string, int> roles_{{"a", QUELL_SCALAR}};
};

class Sink : public FrameSink {
 public:
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    const Attendance::Here here(all);
    EXPECT_EQ(outputs[0].plane[0][63 * outputs[0].pitch + 7], float(frame));
  }
};

RunReport run(int threads) {
  static Registry registry({});
  static const bool added = add_type<Attends>(registry, "attends");
  EXPECT_TRUE(added);
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  const auto* type = registry.find("attends");
  g.nodes.push_back({"node", Instance(*type), {{{{Source::kInput, 0}, 0, {}}}}, {QUELL_SCALAR}, {}});
  g.outputs = {{"out", {{0, 0}, 0, {}}, QUELL_SCALAR, false}};
  filtering.clear(threads > 1), all.clear(false);
  Frames source;
  Sink sink;
  RunOptions options;
  options.threads = threads, options.band_rows = 4;
  return run_graph(g, source, sink, options);
}

TEST(Threads, OneReadsFiltersAndWrites) {
  const auto report = run(1);
  EXPECT_EQ(report.threads, 1);
  EXPECT_EQ(report.frames_in_flight, 1);
  EXPECT_EQ(report.wanted_bytes, 0u) << "nothing was given up for want of memory";
  EXPECT_EQ(all.threads(), std::set{std::this_thread::get_id()});
}

TEST(Threads, NoMoreFilterThanWereAskedFor) {
  for (const int threads : {2, 3}) {
    const auto report = run(threads);
    EXPECT_EQ(report.threads, threads);
    EXPECT_EQ(report.frames_in_flight, 3);
    EXPECT_LE(filtering.most(), threads);
    EXPECT_GT(filtering.most(), 1) << "none worked together, in 96 bands";
  }
}

}  // namespace
}  // namespace quell::test
