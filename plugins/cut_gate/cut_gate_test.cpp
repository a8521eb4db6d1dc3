// The gate, open and shut.
#include <gtest/gtest.h>

#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::Node;
using quell::test::noise_image;
using quell::test::same_bits;

TEST(CutGate, ShutsAboveItsThreshold) {
  const auto motion = noise_image(23, 11, 2, 1, -3, 3);
  const auto taps = Node("disocclusion").in("motion", motion).run("taps");
  for (const float share : {0.0f, 0.39f, 0.4f, 0.41f, 1.0f}) {
    const auto value = constant_image(1, 1, 1, share);
    const auto out = Node("cut_gate").set("threshold", 0.4f).in("taps", taps).in("share", value).run("taps");
    Image none(23, 11, 5);
    none.fill(0);
    EXPECT_TRUE(same_bits(out, share > 0.4f ? none : taps)) << share;
  }
}

TEST(CutGate, AtOneNeverShuts) {
  const auto motion = constant_image(5, 3, 2, 0), share = constant_image(1, 1, 1, 1);
  const auto taps = Node("disocclusion").in("motion", motion).run("taps");
  EXPECT_TRUE(same_bits(Node("cut_gate").set("threshold", 1.0f).in("taps", taps).in("share", share).run("taps"), taps));
}

}  // namespace
