// Measurements: statistics, traffic, the verdict on two of them, JSON, and the timeline of a run.
#include "core/bench/compare.h"

#include "core/bench/looped_source.h"
#include "core/bench/synthetic_source.h"
#include "core/plugin/registry.h"
#include "core/report/error.h"
#include "tests/support/add_type.h"

#include <gtest/gtest.h>
#include <quell/node.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace quell::test {
namespace {

// out = (now + before) / 2.
struct Mix {
  In<Radiance> now, before;
  Out<Radiance> mixed;
  void describe(Describe& d) {
    d.summary("Mixes.");
    d.in(now, "now", "A.");
    d.in(before, "before", "B.");
    d.out(mixed, "image", "Mean.").passes(now);
  }
  void run(const Tile& t) const {
    for (int c = 0; c < 3; ++c)
      for (int y = t.y0; y < t.y1; ++y)
        for (int x = t.x0; x < t.x1; ++x) t.row(mixed, c, y)[x] = (t.row(now, c, y)[x] + t.row(before, c, y)[x]) / 2;
  }
};

// Two mixers in a row; the first reads its input twice, the second what it gave a frame before.
Graph mixers() {
  static Registry registry({});
  static const bool added = add_type<Mix>(registry, "mix");
  EXPECT_TRUE(added);
  const auto* type = registry.find("mix");
  const Wire color{{Source::kInput, 0}, 0, {}};
  Graph g;
  g.name = "mixers";
  g.inputs = {{"color", QUELL_RADIANCE, false}};
  g.nodes.push_back({"first", Instance(*type), {{color}, {color}}, {QUELL_RADIANCE}, {}});
  g.nodes.push_back({"second \"b\"", Instance(*type), {{{{0, 0}, 0, {}}}, {{{1, 0}, 1, {}}}}, {QUELL_RADIANCE}, {}});
  g.outputs = {{"image", {{1, 0}, 0, {}}, QUELL_RADIANCE, false}};
  return g;
}

Timing timed(const Graph& graph, int frames, int warmup, RunOptions options = {}) {
  SyntheticSource source(graph, 40, 90, frames);
  auto timing = measure(graph, source, options, warmup);
  timing.input = "synthetic";
  return timing;
}

// No weight at all, and a filter that asks about two taps for each pixel, row by row.
struct Alike {
  In<Radiance> image;
  Out<Weight> weight;
  void describe(Describe& d) {
    d.summary("Weighs alike.");
    d.in(image, "image", "Anything.");
    d.out(weight, "weight", "1.");
  }
  void weigh(const quell_input*, const quell_run& run, float* exponent) const {
    for (int t = 0; t < run.taps; ++t) std::fill_n(exponent + t * run.row, run.n, 0.0f);
  }
};
struct Ask {
  In<Radiance> image;
  InList<Weight> weights;
  Out<Radiance> out;
  void describe(Describe& d) {
    d.summary("Asks.");
    d.in(image, "image", "What is given back.");
    d.in(weights, "weights", "Who is asked.");
    d.out(out, "image", "The image.").passes(image);
  }
  void run(const Tile& t) const {
    const quell_tap taps[2] = {{0, 0, 0}, {0, 0, 0}};
    float exponent[2 * QUELL_SEGMENT];
    for (int y = t.y0; y < t.y1; ++y) {
      for (const auto& w : t[weights]) {
        const quell_run run{t.x0, y, t.x1 - t.x0, 2, taps, y * t[image].pitch + t.x0, QUELL_SEGMENT, 1, 1};
        w.weigh(w.instance, w.resource, w.in, &run, exponent);
      }
      for (int c = 0; c < 3; ++c) std::copy(t.row(image, c, y) + t.x0, t.row(image, c, y) + t.x1, t.row(out, c, y));
    }
  }
};

Graph asking() {
  static Registry registry({});
  static const bool added = add_type<Alike>(registry, "alike") && add_type<Ask>(registry, "ask");
  EXPECT_TRUE(added);
  const Wire color{{Source::kInput, 0}, 0, {}}, weight{{0, 0}, 0, {}};
  Graph g;
  g.name = "asking";
  g.inputs = {{"color", QUELL_RADIANCE, false}};
  g.nodes.push_back({"alike", Instance(*registry.find("alike")), {{color}}, {QUELL_WEIGHT}, {}});
  for (const std::vector<Wire>& weights : {std::vector<Wire>{}, {weight}, {weight, weight}})
    g.nodes.push_back({"asks_" + std::to_string(weights.size()),
                       Instance(*registry.find("ask")),
                       {{color}, weights},
                       {QUELL_RADIANCE},
                       {}});
  g.outputs = {{"image", {{3, 0}, 0, {}}, QUELL_RADIANCE, false}};
  return g;
}

// A spread whose quartiles lie `apart`.
Spread around(double median, double apart) { return {median, median - apart, median - apart / 2, median + apart / 2}; }

TEST(Timing, SpreadOfKnownNumbers) {
  const auto s = spread_of({9, 1, 5, 3, 7});
  EXPECT_EQ(s.median, 5);
  EXPECT_EQ(s.minimum, 1);
  EXPECT_EQ(s.lower, 3);
  EXPECT_EQ(s.upper, 7);
  EXPECT_EQ(spread_of({1, 2}).median, 1.5);
  EXPECT_EQ(spread_of({4}).quartiles_apart(), 0);
}

TEST(Timing, TrafficCountsEachImageOnce) {
  const auto timing = timed(mixers(), 3, 1);
  const std::size_t image = 40 * 90 * 3 * sizeof(float);
  ASSERT_EQ(timing.nodes.size(), 2u);
  EXPECT_EQ(timing.nodes[0].bytes, 2 * image);  // one input, wired twice, and one output
  EXPECT_EQ(timing.nodes[1].bytes, 3 * image);  // now and before are two
  EXPECT_EQ(timing.nodes[0].pixels, 40u * 90u);
  EXPECT_EQ(timing.frames, 2);
  EXPECT_EQ(timing.warmup, 1);
  EXPECT_EQ(timing.resets, 1u);
  EXPECT_EQ(timing.width, 40);
  EXPECT_EQ(timing.height, 90);
}

// Those of one frame, however many are run and however many weights a filter lists.
TEST(Timing, TapsAreCountedInTheLastFrameOfTheWarmUp) {
  for (const int warmup : {0, 1, 3}) {
    RunOptions options;
    options.threads = 3, options.band_rows = 16;
    const auto timing = timed(asking(), warmup + 2, warmup, options);
    ASSERT_EQ(timing.nodes.size(), 3u);
    const std::uint64_t taps = warmup ? 2 * 40 * 90 : 0;
    EXPECT_EQ(timing.nodes[0].taps, 0u) << "lists no weight";
    EXPECT_EQ(timing.nodes[1].taps, taps);
    EXPECT_EQ(timing.nodes[2].taps, taps);
  }
}

TEST(Timing, PartsAreNoLongerThanTheWhole) {
  const auto timing = timed(mixers(), 6, 1);
  EXPECT_GT(timing.ms.minimum, 0);
  EXPECT_LE(timing.ms.minimum, timing.ms.lower);
  EXPECT_LE(timing.ms.lower, timing.ms.median);
  EXPECT_LE(timing.ms.median, timing.ms.upper);
  EXPECT_LE(timing.nodes[0].ms.minimum + timing.nodes[1].ms.minimum, timing.ms.upper);
  EXPECT_GE(timing.cpu_ms.median, 0);
  EXPECT_GE(timing.peak_bytes, timing.image_bytes);
}

TEST(Timing, NothingIsLeftAfterTheWarmUp) { EXPECT_THROW(timed(mixers(), 2, 2), Error); }

TEST(Timing, ALoopedSequenceEndsHistoryWhereItStartsAnew) {
  const auto graph = mixers();
  SyntheticSource source(graph, 8, 8, 3);
  LoopedSource looped(source, 7);
  EXPECT_EQ(measure(graph, looped, {}, 1).resets, 3u);
}

TEST(Timing, ADifferenceCountsBeyondSpreadShareAndClock) {
  EXPECT_EQ(pace(around(100, 1), around(110, 1)), Pace::slower);
  EXPECT_EQ(pace(around(100, 1), around(90, 1)), Pace::faster);
  EXPECT_EQ(pace(around(100, 1), around(102.9, 1)), Pace::same);    // below 3 %
  EXPECT_EQ(pace(around(100, 1), around(103.1, 1)), Pace::slower);  // above
  EXPECT_EQ(pace(around(100, 12), around(110, 1)), Pace::same);     // the former's spread
  EXPECT_EQ(pace(around(100, 1), around(90, 12)), Pace::same);      // the latter's
  EXPECT_EQ(pace(around(0.1, 0), around(0.14, 0)), Pace::same);     // 40 %, but within what a clock adds
  EXPECT_EQ(pace(around(0.1, 0), around(0.2, 0)), Pace::slower);
}

TEST(Timing, ComparesNodesByNameAndType) {
  Timing before, now;
  before.input = now.input = "synthetic";
  before.width = now.width = 40, before.height = now.height = 90;
  before.ms = around(100, 1), now.ms = around(101, 1);
  before.threads = 1, now.threads = 2;
  before.simd = "avx2", now.simd = "avx3";
  before.nodes = {{"a", "x", around(50, 1)}, {"b", "x", around(50, 1)}, {"gone", "x", around(1, 0)}};
  now.nodes = {{"a", "x", around(60, 1)}, {"b", "y", around(40, 1)}, {"new", "x", around(1, 0)}};
  const auto c = compare(before, now);
  EXPECT_EQ(c.total.pace, Pace::same);
  ASSERT_EQ(c.nodes.size(), 1u);
  EXPECT_EQ(c.nodes[0].name, "a");
  EXPECT_EQ(c.nodes[0].pace, Pace::slower);
  EXPECT_NEAR(c.nodes[0].percent(), 20, 1e-9);
  EXPECT_EQ(c.added, (std::vector<std::string>{"b", "new"}));
  EXPECT_EQ(c.removed, (std::vector<std::string>{"b", "gone"}));
  EXPECT_EQ(c.notes, (std::vector<std::string>{"1 threads before, 2 now", "avx2 before, avx3 now"}));
  EXPECT_TRUE(slower_by(c, 15));
  EXPECT_FALSE(slower_by(c, 25));

  now.width = 41;
  try {
    compare(before, now);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::usage);
    EXPECT_STREQ(
        e.what(),
        "the baseline was measured on synthetic at 40x90, this on synthetic at 41x90; measure both on the same");
  }
}

TEST(Timing, JsonHasTheDocumentedKeysAndComesBack) {
  const auto timing = timed(mixers(), 4, 1);
  const auto text = timing_json(timing);
  const auto j = nlohmann::json::parse(text);
  for (const char* key : {"quell_bench", "graph", "fingerprint", "input", "width", "height", "frames", "warmup",
                          "threads", "simd", "resets", "ms", "cpu_ms", "read_ms", "image_bytes", "peak_bytes", "nodes"})
    EXPECT_TRUE(j.contains(key)) << key;
  for (const char* key : {"name", "type", "ms", "bytes", "pixels", "gigabytes_per_second", "megapixels_per_second",
                          "taps", "megataps_per_second"})
    EXPECT_TRUE(j["nodes"][0].contains(key)) << key;
  for (const char* key : {"median", "minimum", "lower_quartile", "upper_quartile"})
    EXPECT_TRUE(j["ms"].contains(key)) << key;
  EXPECT_EQ(timing_json(parse_timing("t.json", text)), text);
  const auto again = compare(parse_timing("t.json", text), timing);
  EXPECT_EQ(again.total.pace, Pace::same);
  EXPECT_EQ(again.nodes.size(), 2u);
}

TEST(Timing, WhatIsNoMeasurementIsRefused) {
  for (const char* text : {"", "[]", "{}", "{\"quell_bench\": 2}", "{\"quell_bench\": 1, \"graph\": 3}"}) try {
      parse_timing("old.json", text);
      ADD_FAILURE() << text;
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::input);
      EXPECT_TRUE(std::string(e.what()).starts_with("old.json: ")) << e.what();
    }
}

TEST(Trace, EventsNestOnEveryTrack) {
  for (const bool overlap : {true, false}) {
    const auto graph = mixers();
    SyntheticSource source(graph, 40, 90, 4);
    struct : FrameSink {
      void write(std::int64_t, std::span<const quell_image>) override {}
    } sink;
    Trace trace;
    RunOptions options;
    options.threads = 3, options.band_rows = 16, options.trace = &trace, options.overlap = overlap;
    run_graph(graph, source, sink, options);

    struct Event {
      std::int64_t begin, end;  // ns
    };
    std::map<int, std::vector<Event>> tracks;
    std::map<std::string, int> count;
    std::set<std::string> names;
    const auto j = nlohmann::json::parse(trace.json());
    for (const auto& e : j["traceEvents"]) {
      if (e["ph"] == "M") {
        if (e["name"] == "thread_name") names.insert(e["args"]["name"].get<std::string>());
        continue;
      }
      ASSERT_EQ(e["ph"], "X");
      const auto begin = std::llround(1e3 * e["ts"].get<double>()), length = std::llround(1e3 * e["dur"].get<double>());
      ASSERT_GE(begin, 0);
      ASSERT_GE(length, 0);
      tracks[e["tid"].get<int>()].push_back({begin, begin + length});
      ++count[e["name"].get<std::string>() + (e["args"].contains("rows") ? " band" : "")];
    }
    EXPECT_TRUE(names.contains("reading") && names.contains("writing") && names.contains("graph"));
    EXPECT_TRUE(names.contains("thread 1"));
    const std::map<std::string, int> expected{{"read", 4},        {"write", 4},
                                              {"frame", 4},       {"first", 4},  // the chain of both
                                              {"first band", 24}, {"second \"b\" band", 24}};
    EXPECT_EQ(count, expected);
    for (auto& [track, events] : tracks) {
      std::ranges::sort(events, [](const Event& a, const Event& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
      });
      std::vector<Event> open;
      for (const auto& e : events) {
        while (!open.empty() && open.back().end <= e.begin) open.pop_back();
        if (!open.empty()) {
          ASSERT_LE(e.end, open.back().end) << "track " << track;
        }
        open.push_back(e);
      }
    }
  }
}

}  // namespace
}  // namespace quell::test
