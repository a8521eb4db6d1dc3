// Runs of graphs: history, cuts, sizes, threads, and whose time is whose.
#include "core/run/executor.h"

#include "core/sequence/job_time.h"
#include "core/sequence/pieces.h"
#include "tests/support/accumulator.h"

#include <gtest/gtest.h>

#include <time.h>

#include <mutex>
#include <set>
#include <thread>

namespace quell::test {
namespace {

TEST(Executor, HistoryIsTheFrameBefore) {
  Frames source(0, 9);
  Keep sink;
  const auto report = run_graph(accumulator(), source, sink, {});
  ASSERT_EQ(sink.frames.size(), 10u);
  EXPECT_EQ(report.resets, 1u);
  float sum = 0;
  for (int f = 0; f < 10; ++f) {
    sum += float(f);
    EXPECT_EQ(sink.frames[std::size_t(f)].first, f);
    EXPECT_EQ(sink.at(std::size_t(f), 0, 0, 0), sum);
    EXPECT_EQ(sink.at(std::size_t(f), 1, 3, 3), f == 0 ? 1.0f : 0.0f);
  }
}

TEST(Executor, DeclaredCutEndsHistory) {
  Frames source(0, 5);
  source.cut = 3;
  Keep sink;
  EXPECT_EQ(run_graph(accumulator(), source, sink, {}).resets, 2u);
  EXPECT_EQ(sink.at(2, 0, 0, 0), 3.0f);
  EXPECT_EQ(sink.at(3, 0, 0, 0), 3.0f);
  EXPECT_EQ(sink.at(3, 1, 0, 0), 1.0f);
  EXPECT_EQ(sink.at(5, 0, 0, 0), 12.0f);
}

TEST(Executor, ANewSizeEndsHistory) {
  Frames source(0, 5);
  source.wide_from = 4;
  Keep sink;
  const auto report = run_graph(accumulator(), source, sink, {});
  EXPECT_EQ(report.resets, 2u);
  EXPECT_EQ(report.resized, std::vector<std::int64_t>{4});
  EXPECT_EQ(sink.frames[3].second[0].width(), 37);
  EXPECT_EQ(sink.frames[4].second[0].width(), 74);
  EXPECT_EQ(sink.at(4, 0, 0, 0), 4.0f);
  EXPECT_EQ(sink.at(5, 0, 0, 0), 9.0f);
}

TEST(Executor, LongDelaysOfInputsAndOutputs) {
  Graph g = accumulator();
  g.nodes[0] = make("total", "sum", {{{input(), 2, {}}}, {{{0, 0}, 3, {}}}});
  g.outputs.push_back({"before", {input(), 4, {}}, QUELL_SCALAR, false});
  Frames source(1, 9);
  Keep sink;
  run_graph(g, source, sink, {});
  // total(f) = a(f-2) + total(f-3), with a(f) = f from 1 on.
  const float expected[] = {0, 0, 1, 2, 3, 5, 7, 9, 12};
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(sink.at(i, 0, 0, 0), expected[i]) << i;
    EXPECT_EQ(sink.at(i, 2, 0, 0), i < 4 ? 0.0f : float(i - 3)) << i;
  }
}

TEST(Executor, StartStandsInForAMissingPast) {
  Graph g = accumulator();
  g.nodes[0] = make("total", "sum", {{{input(), 0, {}}}, {{{0, 0}, 1, input()}}});
  Frames source(5, 6);
  Keep sink;
  run_graph(g, source, sink, {});
  EXPECT_EQ(sink.at(0, 0, 0, 0), 10.0f);
  EXPECT_EQ(sink.at(0, 1, 0, 0), 0.0f);
  EXPECT_EQ(sink.at(1, 0, 0, 0), 16.0f);
}

TEST(Executor, SameBitsForAnyThreadsAndBands) {
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("total", "sum", {{{input(), 0, {}}}, {{{2, 0}, 1, {}}}}));
  g.nodes.push_back(make("small", "blur", {{{{0, 0}, 0, {}}}}));
  g.nodes.push_back(make("large", "blur", {{{{1, 0}, 0, {}}}}));
  g.nodes[2].instance.set_int(1, 8);
  g.outputs = {{"out", {{2, 0}, 0, {}}, QUELL_SCALAR, false}};
  std::vector<Keep> results;
  for (const int threads : {1, 2, 4})
    for (const int rows : {0, 1, 7, 64, 1000}) {
      Frames source(0, 4);
      RunOptions options;
      options.threads = threads, options.band_rows = rows;
      run_graph(g, source, results.emplace_back(), options);
    }
  for (const auto& r : results)
    for (std::size_t f = 0; f < 5; ++f) EXPECT_TRUE(same(r.frames[f].second[0], results[0].frames[f].second[0]));
}

// Reads and writes in pieces, and remembers the threads that worked.
struct Crew {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  void work() {
    in_pieces(16, [this](int) {
      const std::scoped_lock lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
  }
};

TEST(Executor, ReadsFiltersAndWritesOnTheThreadsThatWereAskedFor) {
  for (const int threads : {1, 2}) {
    Crew crew;
    struct Source : Frames {
      using Frames::Frames;
      void read(std::int64_t f, std::span<const std::string> r, std::span<const quell_image> into) override {
        crew->work();
        Frames::read(f, r, into);
      }
      Crew* crew = nullptr;
    } source(0, 20);
    struct Sink : Keep {
      void write(std::int64_t f, std::span<const quell_image> outputs) override {
        crew->work();
        Keep::write(f, outputs);
      }
      Crew* crew = nullptr;
    } sink;
    source.crew = sink.crew = &crew;
    RunOptions options;
    options.threads = threads;
    run_graph(accumulator(), source, sink, options);
    EXPECT_EQ(sink.frames.size(), 21u);
    EXPECT_LE(crew.threads.size(), std::size_t(threads));
    if (threads == 1) {
      EXPECT_TRUE(crew.threads.contains(std::this_thread::get_id()));
    }
  }
}

void burn(double seconds) {
  const auto now = [] {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  };
  for (const double end = now() + seconds; now() < end;) {
  }
}

TEST(Executor, TellsTheWorkOfFilesFromTheRest) {
  struct Source : Frames {
    using Frames::Frames;
    void read(std::int64_t f, std::span<const std::string> r, std::span<const quell_image> into) override {
      burn(1e-3);
      in_pieces(4, [](int) { burn(1e-3); });
      Frames::read(f, r, into);
    }
  } source(0, 4);
  struct Sink : Keep {
    void write(std::int64_t f, std::span<const quell_image> outputs) override {
      in_pieces(2, [](int) { burn(1e-3); });
      Keep::write(f, outputs);
    }
  } sink;
  for (const int threads : {1, 3}) {
    RunOptions options;
    options.threads = threads;
    const auto report = run_graph(accumulator(), source, sink, options);
    EXPECT_GE(report.read_cpu, 5 * 5e-3);
    EXPECT_GE(report.write_cpu, 5 * 2e-3);
    EXPECT_GE(report.filter_cpu, 0.0);
    // Whatever a thread did while it waited for its pieces is not the job's.
    JobTime job;
    {
      const JobSpan span(job);
      burn(1e-3);
      const ThreadTime other(nullptr);
      burn(0.1);
    }
    EXPECT_GE(job.cpu, 1'000'000);
    EXPECT_LT(job.cpu, 50'000'000);
  }
}

}  // namespace
}  // namespace quell::test
