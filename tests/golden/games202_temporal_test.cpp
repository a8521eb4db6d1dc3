// The temporal step of GAMES202 homework 5 on the box sequence: frame 1 accumulated onto frame 0, both filtered.
//
// The values are those of the formulas in double precision: history at the nearest previous pixel, clamped to mean ±
// sigma of the 7x7 around the pixel in the filtered frame 1, alpha 0.2.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/support/data_sequence.h"
#include "tests/support/run_shipped.h"

namespace quell::test {
namespace {

Image copy(const quell_image& from) {
  Image to(from.width, from.height, from.channels);
  for (int c = 0; c < from.channels; ++c)
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) to.at(c, x, y) = from.plane[c][y * from.pitch + x];
  return to;
}

TEST(Games202, TemporalStep) {
  if (!has_data()) GTEST_SKIP() << "QUELL_TEST_DATA is not set";
  DataSequence box("games202-box", "games202-box", "0-1");
  using enum Edit::Kind;
  std::map<std::string, Image> kept;
  run_shipped("games202", {{tap, "filtered.image"}, {tap, "history.image"}, {tap, "clamp.image"}, {tap, "age.count"}},
              box.files(), [&](std::int64_t frame, const FrameOutputs& of_frame) {
                for (const auto& [name, image] : of_frame) kept[std::to_string(frame) + " " + name] = copy(image);
              });
  const auto &now = kept.at("1 filtered.image"), &history = kept.at("1 history.image");
  const auto &clamped = kept.at("1 clamp.image"), &count = kept.at("1 age.count"), &out = kept.at("1 color");

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
  // The first frame is what was filtered, to the bit.
  for (int x = 0; x < 512; ++x) EXPECT_EQ(kept.at("0 color").at(1, x, 300), kept.at("0 filtered.image").at(1, x, 300));
  // Where it was the frame before, another object is seen.
  EXPECT_EQ(count.at(0, 250, 204), 1);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(out.at(c, 250, 204), now.at(c, 250, 204));
  EXPECT_NEAR(out.at(0, 250, 204), .190524, 2e-5);
}

}  // namespace
}  // namespace quell::test
