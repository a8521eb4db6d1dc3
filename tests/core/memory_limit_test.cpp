// Frames in flight that a limit of memory leaves, and what is said where it leaves none.
#include "core/run/memory_limit.h"

#include "core/report/error.h"
#include "tests/support/graph_nodes.h"

#include <gtest/gtest.h>

namespace quell {
namespace {

// Three inputs and one output.
const Graph& graph() {
  static const auto loaded = test::load_text(R"({"quell": 1,
    "inputs": {"color": "radiance", "albedo": "albedo", "depth": "depth"},
    "nodes": {
      "plain": {"type": "demodulate", "in": {"image": "color", "albedo": "albedo"}},
      "slope": {"type": "depth_slope", "in": {"depth": "depth"}},
      "by_depth": {"type": "depth_weight", "in": {"depth": "depth", "slope": "slope"}},
      "wide": {"type": "atrous", "in": {"image": "plain", "weights": ["by_depth"]}, "set": {"step": 2}},
      "whole": {"type": "modulate", "in": {"image": "wide.image", "albedo": "albedo"}}},
    "outputs": {"color": "whole"}})");
  EXPECT_TRUE(loaded.graph) << loaded.messages;
  return *loaded.graph;
}

const std::vector<quell_shape> kShapes = {{640, 360, 3}, {640, 360, 3}, {640, 360, 1}};

std::size_t bytes(Overlap overlap) { return Plan(graph(), kShapes, overlap).bytes(); }
Plan within(std::size_t limit, Overlap wanted = {}) { return plan_within(graph(), kShapes, wanted, limit); }

TEST(MemoryLimit, LessOverlapTakesLess) {
  const auto reading = bytes({true, false}), writing = bytes({false, true}), none = bytes({false, false});
  EXPECT_LT(none, writing);
  EXPECT_LT(writing, reading);  // seven planes come in, three go out
  EXPECT_LT(reading, bytes({}));
}

TEST(MemoryLimit, WithoutOverlapInputsAndOutputsShareTheArena) {
  const Plan plan(graph(), kShapes, {false, false});
  EXPECT_EQ(plan.ring_floats(), 0u);
  const auto& color = plan.values()[0];
  EXPECT_EQ(place_of(color), "steps 0-0");
  const auto& whole = plan.values()[plan.value_of(graph().outputs[0].wire.from)];
  EXPECT_EQ(whole.last, int(graph().nodes.size()));
  EXPECT_LT(plan.bytes(), plan.bytes_without_reuse());
}

TEST(MemoryLimit, TakesTheMostOverlapThatFits) {
  struct Case {
    std::size_t limit;
    Overlap wanted, expected;
  };
  const auto all = bytes({}), reading = bytes({true, false}), writing = bytes({false, true}),
             none = bytes({false, false});
  for (const auto& c : {Case{0, {}, {}},
                        {all, {}, {}},
                        {all - 1, {}, {true, false}},
                        {reading, {}, {true, false}},
                        {reading - 1, {}, {false, true}},
                        {writing, {}, {false, true}},
                        {writing - 1, {}, {false, false}},
                        {none, {}, {false, false}},
                        {0, {false, false}, {false, false}},
                        {all, {false, true}, {false, true}},
                        {all, {true, false}, {true, false}}}) {
    const auto plan = within(c.limit, c.wanted);
    EXPECT_EQ(plan.overlap().reading, c.expected.reading) << c.limit;
    EXPECT_EQ(plan.overlap().writing, c.expected.writing) << c.limit;
    if (c.limit) {
      EXPECT_LE(plan.bytes(), c.limit);
    }
  }
}

TEST(MemoryLimit, RefusesWithTheLargestBuffersAndALimitThatWouldDo) {
  try {
    within(4 << 20);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::resources);
    EXPECT_STREQ(e.what(),
                 "the images of one frame need 10.6 MiB, but the limit is 4.0 MiB; the largest buffers:\n"
                 "  color: 2.6 MiB (radiance 640x360x3, steps 0-0)\n"
                 "  albedo: 2.6 MiB (albedo 640x360x3, steps 0-4)\n"
                 "  plain.image: 2.6 MiB (radiance 640x360x3, steps 0-3)\n"
                 "  wide.image: 2.6 MiB (radiance 640x360x3, steps 3-4)\n"
                 "  whole.image: 2.6 MiB (radiance 640x360x3, steps 4-5)\n"
                 "  raise --max-memory to 0.011 (GiB), or use smaller frames");
  }
  EXPECT_NO_THROW(within(std::size_t(0.011 * 1024 * 1024 * 1024)));
}

TEST(MemoryLimit, TellsSizesInUnitsThatSaySomething) {
  EXPECT_EQ(size_text(0), "0.0 KiB");
  EXPECT_EQ(size_text(1000 * 1024), "1000.0 KiB");
  EXPECT_EQ(size_text(1024 * 1024), "1.0 MiB");
  EXPECT_EQ(size_text(std::size_t(5) << 30), "5120.0 MiB");
}

}  // namespace
}  // namespace quell
