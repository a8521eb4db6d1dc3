// The executor on nodes made for the purpose: history, cuts, sizes, state, threads, errors.
#include "core/run/executor.h"

#include "core/image/image.h"
#include "core/plugin/registry.h"
#include "core/report/error.h"
#include "core/run/plan.h"
#include "core/sequence/job_time.h"
#include "core/sequence/pieces.h"

#include <gtest/gtest.h>
#include <quell/node.h>

#include <time.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

namespace quell {
namespace {

// out = now + before, and before's missing flag in the second output.
struct Sum {
  In<Scalar> now, before;
  Out<Scalar> sum;
  Out<Count> missing;
  void describe(Describe& d) {
    d.summary("Adds.");
    d.in(now, "now", "A.");
    d.in(before, "before", "B.").optional();
    d.out(sum, "sum", "A + B.").passes(now);
    d.out(missing, "missing", "1 where B has no past.");
  }
  void run(const Tile& t) const {
    for (int y = t.y0; y < t.y1; ++y)
      for (int x = t.x0; x < t.x1; ++x) {
        t.row(sum, 0, y)[x] = t.row(now, 0, y)[x] + (t.has(before) ? t.row(before, 0, y)[x] : 0);
        t.row(missing, 0, y)[x] = t.missing(before) ? 1.0f : 0.0f;
      }
  }
};

// Mean of rows up to `radius` above and below, read `step` apart; counts its calls in no state, for it has none.
struct Blur {
  In<Scalar> image;
  Out<Scalar> blurred;
  int radius = 2, step = 1;
  void describe(Describe& d) {
    d.summary("Blurs.");
    d.in(image, "image", "A.").halo(0, radius * step).step(step);
    d.out(blurred, "image", "Blurred.").passes(image);
    d.param(radius, "radius", "Rows.").range(0, 16);
    d.param(step, "step", "Rows apart.").range(1, 64);
  }
  void run(const Tile& t) const {
    const int h = t[image].height;
    for (int y = t.y0; y < t.y1; ++y)
      for (int x = t.x0; x < t.x1; ++x) {
        float sum = 0, n = 0;
        for (int k = -radius; k <= radius; ++k)
          if (const int v = y + k * step; v >= 0 && v < h)
            sum += t.row(image, 0, v)[x] * float(k + 20), n += float(k + 20);
        t.row(blurred, 0, y)[x] = sum / n;
      }
  }
};

struct Fails {
  In<Scalar> image;
  Out<Scalar> out;
  int at_row = 5;
  void describe(Describe& d) {
    d.summary("Fails.");
    d.in(image, "image", "A.");
    d.out(out, "image", "B.");
    d.param(at_row, "at_row", "Row.");
  }
  void run(const Tile& t) const {
    if (t.frame >= 3 && t.y0 <= at_row && at_row < t.y1)
      throw std::runtime_error("row " + std::to_string(at_row) + " is unlucky");
    for (int y = t.y0; y < t.y1; ++y) std::fill_n(t.row(out, 0, y) + t.x0, t.x1 - t.x0, 1.0f);
  }
};

Registry& nodes() {
  static Registry registry({});
  static const NodeTable<Sum> sum("sum");
  static const NodeTable<Blur> blur("blur");
  static const NodeTable<Fails> fails("fails");
  static const quell_node* const list[] = {sum.node(), blur.node(), fails.node()};
  static const quell_plugin_table table{QUELL_MAGIC, QUELL_ABI_MAJOR, QUELL_ABI_MINOR, sizeof(quell_plugin_table), 3,
                                        list,        "1.0",           "test"};
  static const bool added = (registry.add_static(&table), true);
  EXPECT_TRUE(added && registry.problems().empty());
  return registry;
}

GraphNode make(const char* name, const char* type, std::vector<std::vector<Wire>> in) {
  const auto* t = nodes().find(type);
  std::vector<int> types;
  for (const auto& o : t->outputs()) types.push_back(o.type);
  return {name, Instance(*t), std::move(in), types, {}};
}

constexpr Source input(int port = 0) { return {Source::kInput, port}; }

// total = a + total@-1: the sum of all frames so far.
Graph accumulator() {
  Graph g;
  g.name = "accumulator";
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("total", "sum", {{{input(), 0, {}}}, {{{0, 0}, 1, {}}}}));
  g.outputs = {{"total", {{0, 0}, 0, {}}, QUELL_SCALAR, false}, {"missing", {{0, 1}, 0, {}}, QUELL_COUNT, false}};
  return g;
}

// Frame f holds f + x / 1000 + y / 7.
class Frames : public FrameSource {
 public:
  Frames(std::int64_t first, std::int64_t last) {
    for (auto f = first; f <= last; ++f) frames_.push_back(f);
  }
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t f) const override { return f == frames_[0] || declared_cut(f); }
  bool declared_cut(std::int64_t f) const override { return f == cut; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t f, std::span<const std::string> r) override {
    return std::vector<quell_shape>(r.size(), quell_shape{f >= wide_from ? 2 * width : width, height, 1});
  }
  void read(std::int64_t f, std::span<const std::string>, std::span<const quell_image> into) override {
    if (f == broken) throw Error(Exit::input, "frame is broken");
    for (const auto& image : into)
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
          image.plane[0][y * image.pitch + x] = float(f) + float(x) / 1000 + float(y) / 7;
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }

  int width = 37, height = 101;
  std::int64_t cut = -1, wide_from = 1 << 20, broken = -1;

 private:
  std::vector<std::int64_t> frames_;
  std::map<std::string, int> roles_{{"a", QUELL_SCALAR}};
};

class Keep : public FrameSink {
 public:
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    auto& kept = frames.emplace_back(frame, std::vector<Image>()).second;
    for (const auto& o : outputs) {
      Image copy(o.width, o.height, o.channels);
      for (int c = 0; c < o.channels; ++c)
        for (int y = 0; y < o.height; ++y) std::copy_n(o.plane[c] + y * o.pitch, o.width, copy.row(c, y));
      kept.push_back(std::move(copy));
    }
  }
  float at(std::size_t i, int output, int x, int y) const { return frames[i].second[std::size_t(output)].at(0, x, y); }
  std::vector<std::pair<std::int64_t, std::vector<Image>>> frames;
};

bool same(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels()) return false;
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * 4)) return false;
  return true;
}

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

class State : public testing::Test {
 protected:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / ("quell_state_" + std::to_string(getpid()));
  void TearDown() override { std::filesystem::remove(path_); }
  RunOptions saving() { return {.save_state = path_}; }
  RunOptions loading() { return {.load_state = path_}; }
  std::string failure(const Graph& g, Frames source) {
    Keep sink;
    try {
      run_graph(g, source, sink, loading());
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(State, AChunkedRunGivesTheSameBits) {
  Graph g = accumulator();
  g.nodes[0] = make("total", "sum", {{{input(), 2, {}}}, {{{0, 0}, 3, {}}}});
  Keep whole, first, second;
  Frames all(0, 9), a(0, 4), b(5, 9);
  run_graph(g, all, whole, {});
  run_graph(g, a, first, saving());
  EXPECT_EQ(run_graph(g, b, second, loading()).resets, 0u);
  for (std::size_t f = 0; f < 10; ++f)
    for (std::size_t o = 0; o < 2; ++o)
      EXPECT_TRUE(same(whole.frames[f].second[o], (f < 5 ? first.frames[f] : second.frames[f - 5]).second[o])) << f;
}

TEST_F(State, AShortPastStaysShort) {
  Graph g = accumulator();
  g.nodes[0] = make("total", "sum", {{{input(), 0, {}}}, {{{0, 0}, 3, {}}}});
  Keep whole, sink, rest;
  Frames all(0, 3), a(0, 0), b(1, 3);
  run_graph(g, all, whole, {});
  run_graph(g, a, sink, saving());
  run_graph(g, b, rest, loading());
  for (std::size_t f = 1; f < 4; ++f) EXPECT_TRUE(same(whole.frames[f].second[1], rest.frames[f - 1].second[1])) << f;
}

TEST_F(State, RefusesWhatDoesNotFit) {
  Keep sink;
  Frames a(0, 4);
  run_graph(accumulator(), a, sink, saving());
  const std::string name = path_.string();
  EXPECT_EQ(failure(accumulator(), Frames(7, 9)),
            name + ": cannot load state: it was saved after frame 4, so a run must go on with frame 5, not 7");
  Frames wide(5, 9);
  wide.width = 20;
  EXPECT_EQ(failure(accumulator(), wide),
            name + ": cannot load state: 'total.sum' was 37x101 with 1 channels, now 20x101 with 1");
  Graph other = accumulator();
  other.nodes.push_back(make("blur", "blur", {{{{0, 0}, 0, {}}}}));
  EXPECT_NE(failure(other, Frames(5, 9)).find("it was saved by another graph"), std::string::npos);

  const auto size = std::filesystem::file_size(path_);
  {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(std::streamoff(size / 2));
    file.put('x');
  }
  EXPECT_EQ(failure(accumulator(), Frames(5, 9)),
            name + ": cannot load state: its checksum does not fit; save it anew");
  std::filesystem::resize_file(path_, size / 2);
  EXPECT_EQ(failure(accumulator(), Frames(5, 9)), name + ": cannot load state: it ends too early; save it anew");
  std::filesystem::remove(path_);
  EXPECT_EQ(failure(accumulator(), Frames(5, 9)), name + ": cannot load state: No such file or directory");
}

TEST_F(State, RefusesCountsThatCannotBeCountedOn) {
  Keep sink;
  Frames a(0, 4);
  run_graph(accumulator(), a, sink, saving());
  // Behind the magic and the fingerprint: the frame, then the age.
  for (const auto& [offset, value] :
       {std::pair<int, std::int64_t>{24, INT64_MAX}, {32, INT64_MAX}, {32, 0}, {32, -1}}) {
    Frames first(0, 4);
    run_graph(accumulator(), first, sink, saving());
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(offset);
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
    file.close();
    EXPECT_EQ(failure(accumulator(), Frames(5, 9)), path_.string() + ": cannot load state: it is damaged; save it anew")
        << offset << ": " << value;
  }
}

// In a folder that others may write to, a name that can be foretold may be a link that they made.
TEST_F(State, IsWrittenToNoNameThatCanBeForetold) {
  const auto victim = path_.string() + ".victim", link = path_.string() + ".tmp" + std::to_string(getpid());
  std::ofstream(victim) << "mine";
  std::filesystem::create_symlink(victim, link);
  Keep sink;
  Frames a(0, 4);
  run_graph(accumulator(), a, sink, saving());
  std::string text;
  std::ifstream(victim) >> text;
  EXPECT_EQ(text, "mine");
  std::filesystem::remove(link);
  std::filesystem::remove(victim);
}

TEST(Executor, AFailingNodeNamesItselfFrameAndRows) {
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("bad.luck", "fails", {{{input(), 0, {}}}}));
  g.outputs = {{"out", {{0, 0}, 0, {}}, QUELL_SCALAR, false}};
  Frames source(0, 9);
  Keep sink;
  RunOptions options;
  options.threads = 2, options.band_rows = 4;
  try {
    run_graph(g, source, sink, options);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::plugin);
    EXPECT_STREQ(e.what(), "bad.luck (fails), frame 3, rows 4-7: row 5 is unlucky");
  }
  EXPECT_EQ(sink.frames.size(), 3u);  // what was done before is written
}

TEST(Executor, ABrokenFrameEndsTheRunAfterThoseBefore) {
  Frames source(0, 9);
  source.broken = 6;
  Keep sink;
  EXPECT_THROW(run_graph(accumulator(), source, sink, {}), Error);
  EXPECT_EQ(sink.frames.size(), 6u);
}

TEST(Executor, RefusesMoreMemoryThanAllowed) {
  Frames source(0, 1);
  Keep sink;
  RunOptions options;
  options.max_memory = 1000;
  try {
    run_graph(accumulator(), source, sink, options);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::resources);
  }
}

TEST(Executor, CancelStops) {
  Frames source(0, 9);
  Keep sink;
  std::atomic<bool> cancel = false;
  RunOptions options;
  options.cancel = &cancel;
  options.progress = [&](const Progress& p) { cancel = p.done == 4; };
  try {
    run_graph(accumulator(), source, sink, options);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::interrupted);
  }
  EXPECT_EQ(sink.frames.size(), 4u);
}

TEST(Executor, CancelStopsAGraphWithoutNodesToo) {
  Graph g = accumulator();
  g.nodes.clear();
  g.outputs = {{"as_it_is", {input(), 0, {}}, QUELL_SCALAR, false}};
  Frames source(0, 9);
  Keep sink;
  std::atomic<bool> cancel = false;
  RunOptions options;
  options.cancel = &cancel;
  options.progress = [&](const Progress& p) { cancel = p.done == 4; };
  EXPECT_THROW(run_graph(g, source, sink, options), Error);
  EXPECT_EQ(sink.frames.size(), 4u);
}

std::vector<std::pair<std::size_t, std::size_t>> chains(const Plan& plan) {
  std::vector<std::pair<std::size_t, std::size_t>> nodes;
  for (const auto& chain : plan.chains()) nodes.emplace_back(chain.first, chain.end);
  return nodes;
}

// Nodes that read each other at their own rows run together; what no other nor the future reads is a band.
TEST(Plan, ChainsNodesUpToAHalo) {
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("blur", "blur", {{{input(), 0, {}}}}));
  g.nodes.push_back(make("sum", "sum", {{{{0, 0}, 0, {}}}, {{input(), 0, {}}}}));
  g.nodes.push_back(make("total", "sum", {{{{1, 0}, 0, {}}}, {{{2, 0}, 1, {}}}}));
  g.nodes.push_back(make("again", "blur", {{{{2, 0}, 0, {}}}}));
  g.nodes.push_back(make("last", "sum", {{{{3, 0}, 0, {}}}, {{{2, 0}, 0, {}}}}));
  g.outputs = {{"out", {{4, 0}, 0, {}}, QUELL_SCALAR, false}};
  const quell_shape shape{100, 50, 1};
  const Plan plan(g, {&shape, 1});
  EXPECT_EQ(chains(plan), (std::vector<std::pair<std::size_t, std::size_t>>{{0, 3}, {3, 5}}));
  const auto local = [&](int node) { return plan.values()[plan.value_of({node, 0})].local; };
  EXPECT_TRUE(local(0) && local(1) && local(3));
  EXPECT_FALSE(local(2)) << "it is read in the next chain and in the next frame";
  EXPECT_FALSE(local(4)) << "it is an output";
  EXPECT_EQ(plan.arena_floats(), 0u);
  const quell_shape large{3840, 2160, 1};
  EXPECT_LT(Plan(g, {&large, 1}).band_rows(plan.chains()[0], 2, 0), 32) << "what the chain makes must fit the cache";
}

TEST(Plan, WhatTheNextDoNotReadIsNoPartOfTheirChain) {
  Graph g;
  g.inputs = {{"a", QUELL_SCALAR, false}};
  g.nodes.push_back(make("apart", "blur", {{{input(), 0, {}}}}));
  g.nodes.push_back(make("sum", "sum", {{{input(), 0, {}}}, {}}));
  g.nodes.push_back(make("double", "sum", {{{{1, 0}, 0, {}}}, {{{1, 0}, 0, {}}}}));
  g.nodes.push_back(make("steps", "blur", {{{{0, 0}, 0, {}}}}));
  g.nodes[3].instance.set_int(1, 8);
  g.nodes.push_back(make("last", "sum", {{{{3, 0}, 0, {}}}, {{{2, 0}, 0, {}}}}));
  g.outputs = {{"out", {{4, 0}, 0, {}}, QUELL_SCALAR, false}};
  const quell_shape shape{100, 50, 1};
  const Plan plan(g, {&shape, 1});
  EXPECT_EQ(chains(plan), (std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {1, 3}, {3, 4}, {4, 5}}))
      << "rows by residue are for one node alone";
}

TEST(Plan, TellsOrderAndMemory) {
  const Graph g = accumulator();
  const quell_shape shape{100, 50, 1};
  const Plan plan(g, {&shape, 1});
  const auto text = plan.describe();
  EXPECT_NE(text.find("total"), std::string::npos);
  EXPECT_NE(text.find("ring of 3"), std::string::npos);  // of the total: now, one before, one being written
  EXPECT_LE(plan.bytes(), plan.bytes_without_reuse());
}

}  // namespace
}  // namespace quell
