// The temporal step of GAMES202 homework 5 on the box sequence: frame 1 accumulated onto frame 0, both filtered.
//
// The values are those of the formulas in double precision: history at the nearest previous pixel, clamped to mean ±
// sigma of the 7x7 around the pixel in the filtered frame 1, alpha 0.2.
#include <gtest/gtest.h>

#include "tests/support/data_sequence.h"
#include "tests/support/run_node.h"

namespace quell::test {
namespace {

Image filtered(DataSequence& box, int frame) {
  const auto color = box.read(frame, "color"), normal = box.read(frame, "normal"),
             position = box.read(frame, "position");
  Node by_color("color_weight"), by_normal("normal_weight"), by_plane("plane_weight"), window("window");
  by_color.set("sigma", 0.6f).in("image", color);
  by_normal.set("mode", "angle").set("sigma", 0.1f).in("normal", normal);
  by_plane.set("sigma", 0.1f).in("normal", normal).in("position", position);
  window.set("radius", 16).set("sigma", 32.0f).in("image", color);
  return window.in("weights", by_color).in("weights", by_normal).in("weights", by_plane).run("image");
}

TEST(Games202, TemporalStep) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  DataSequence box("games202-box", "games202-box");
  const auto before = filtered(box, 0), now = filtered(box, 1);
  const auto position = box.read(1, "position"), id = box.read(1, "id"), id_before = box.read(0, "id");
  const auto camera = box.read(1, "camera"), camera_before = box.read(0, "camera");
  const auto objects = box.read(1, "transforms"), objects_before = box.read(0, "transforms");
  const auto motion = Node("motion_vectors")
                          .in("position", position)
                          .in("id", id)
                          .in("camera", camera)
                          .in("camera_before", camera_before)
                          .in("transforms", objects)
                          .in("transforms_before", objects_before)
                          .run("motion");
  const auto taps = Node("disocclusion")
                        .set("mode", "nearest")
                        .set("fallback", false)
                        .in("motion", motion)
                        .in("id", id)
                        .in("id_before", id_before)
                        .run("taps");
  const auto one = constant_image(512, 512, 1, 1);
  const auto count = Node("history_length").in("before", one).in("motion", motion).in("taps", taps).run("count");
  const auto history = Node("reproject").in("image", before).in("motion", motion).in("taps", taps).run("image");
  const auto clamped = Node("temporal_clamp").in("history", history).in("current", now).run("image");
  const auto out = Node("temporal_blend")
                       .set("alpha", 0.2f)
                       .set("warm_up", false)
                       .in("current", now)
                       .in("history", clamped)
                       .in("count", count)
                       .run("image");

  struct Golden {
    int x, y;
    double now[3], history[3], clamped[3], out[3];
  };
  for (const Golden& g : {Golden{100,
                                 300,
                                 {.102986, .070293, .061327},
                                 {.100471, .069315, .061245},
                                 {.102526, .069517, .061245},
                                 {.102618, .069672, .061262}},
                          {330,
                           380,
                           {.089629, .087449, .068600},
                           {.090479, .084951, .067514},
                           {.090479, .085887, .067514},
                           {.090309, .086200, .067731}},
                          {273,
                           208,
                           {.393049, .391744, .384640},
                           {.361647, .357573, .354943},
                           {.361647, .357573, .354943},
                           {.367927, .364407, .360882}}}) {
    EXPECT_EQ(count.at(0, g.x, g.y), 2);
    for (int c = 0; c < 3; ++c) {
      SCOPED_TRACE(testing::Message() << g.x << ',' << g.y << " channel " << c);
      EXPECT_NEAR(now.at(c, g.x, g.y), g.now[c], 2e-5);
      EXPECT_NEAR(history.at(c, g.x, g.y), g.history[c], 2e-5);
      EXPECT_NEAR(clamped.at(c, g.x, g.y), g.clamped[c], 2e-5);
      EXPECT_NEAR(out.at(c, g.x, g.y), g.out[c], 2e-5);
    }
  }
  // Where it was the frame before, another object is seen.
  EXPECT_EQ(count.at(0, 250, 204), 1);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(out.at(c, 250, 204), now.at(c, 250, 204));
  EXPECT_NEAR(out.at(0, 250, 204), .190524, 2e-5);
}

}  // namespace
}  // namespace quell::test
