// Runs that end before their last frame: what fails, what is too large, what is cancelled.
#include "core/run/executor.h"

#include "tests/support/accumulator.h"

#include <gtest/gtest.h>

#include <atomic>

namespace quell::test {
namespace {

TEST(ExecutorEnds, AFailingNodeNamesItselfFrameAndRows) {
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

TEST(ExecutorEnds, ABrokenFrameEndsTheRunAfterThoseBefore) {
  Frames source(0, 9);
  source.broken = 6;
  Keep sink;
  EXPECT_THROW(run_graph(accumulator(), source, sink, {}), Error);
  EXPECT_EQ(sink.frames.size(), 6u);
}

TEST(ExecutorEnds, RefusesMoreMemoryThanAllowed) {
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

TEST(ExecutorEnds, CancelStops) {
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

TEST(ExecutorEnds, CancelStopsAGraphWithoutNodesToo) {
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

}  // namespace
}  // namespace quell::test
