// The checks of the contract suite find what they are for: nodes that break one rule each.
#include "tests/contract/checks.h"

#include <quell/node.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace quell::test {

namespace {

using testing::HasSubstr;

// What a broken node does wrong.
enum class Fault {
  none,
  reads_farther,      // one row below the declared reach
  skips_last_column,  // leaves a pixel unwritten
  writes_next_row,    // writes below the tile
  knows_its_tile,     // result depends on where the tile begins
  keeps_state,        // result depends on earlier calls
  divides_by_zero,
};

// A vertical mean of three rows, or a broken one.
template <Fault fault>
struct Mean3 {
  In<Radiance> image;
  Out<Radiance> mean;

  void describe(Describe& d) {
    d.summary("Means three rows.");
    d.in(image, "image", "Image.").halo(0, 1);
    d.out(mean, "image", "Mean.");
  }

  void run(const Tile& tile) const {
    static std::atomic<int> calls = 0;
    ++calls;
    const int height = tile[image].height, width = tile[image].width;
    const int columns = fault == Fault::skips_last_column && tile.x1 == width ? tile.x1 - 1 : tile.x1;
    const int rows = fault == Fault::writes_next_row ? std::min(tile.y1 + 1, height) : tile.y1;
    const int below = fault == Fault::reads_farther ? 2 : 1;
    for (int c = 0; c < 3; ++c)
      for (int y = tile.y0; y < rows; ++y) {
        const float* above_row = tile.row(image, c, std::max(y - 1, 0));
        const float* row = tile.row(image, c, y);
        const float* below_row = tile.row(image, c, std::min(y + below, height - 1));
        float* out = tile.row(mean, c, y);
        for (int x = tile.x0; x < columns; ++x) {
          out[x] = (above_row[x] + row[x] + below_row[x]) / 3;
          if (fault == Fault::knows_its_tile) out[x] += float(tile.y0) * 1e-3f;
          if (fault == Fault::keeps_state) out[x] += float(calls);
          if (fault == Fault::divides_by_zero) out[x] = row[x] / 0.0f;
        }
      }
  }
};

template <class Node>
const NodeType& type_of(const char* name) {
  static const NodeTable<Node> table(name);
  static const quell_plugin_table plugin{};
  static const NodeType type(table.node(), &plugin, "");
  return type;
}

template <Fault fault>
Use use() {
  return Use(type_of<Mean3<fault>>("mean"), Choices{});
}

TEST(ContractChecks, PassAnHonestNode) {
  const auto honest = use<Fault::none>();
  EXPECT_EQ(breaks_when_run(honest), "");
  EXPECT_EQ(breaks_in_tiles(honest, 1, 0), "");
  EXPECT_EQ(breaks_in_tiles(honest, 5, 23), "");
  EXPECT_EQ(breaks_in_threads(honest, 4), "");
  EXPECT_EQ(breaks_on_non_finite(honest), "");
}

TEST(ContractChecks, FindADishonestReach) {
  const auto liar = use<Fault::reads_farther>();
  EXPECT_EQ(breaks_when_run(liar), "");
  EXPECT_THAT(breaks_in_tiles(liar, 7, 0), HasSubstr("nan"));
  EXPECT_THAT(breaks_on_non_finite(liar), HasSubstr("nan in a radiance"));
}

TEST(ContractChecks, FindAnUnwrittenPixel) {
  EXPECT_THAT(breaks_when_run(use<Fault::skips_last_column>()), HasSubstr("pixel (66, 0) of channel 0 is not written"));
}

TEST(ContractChecks, FindAWriteOutsideTheTile) {
  EXPECT_EQ(breaks_when_run(use<Fault::writes_next_row>()), "");
  EXPECT_THAT(breaks_in_tiles(use<Fault::writes_next_row>(), 7, 0), HasSubstr("written at (0, 7), outside the tile"));
}

TEST(ContractChecks, FindADependenceOnTiles) {
  EXPECT_THAT(breaks_in_tiles(use<Fault::knows_its_tile>(), 7, 0), HasSubstr("tile [0, 67) × [7, 14)"));
  EXPECT_NE(breaks_in_threads(use<Fault::knows_its_tile>(), 2), "");
}

TEST(ContractChecks, FindState) { EXPECT_NE(breaks_in_threads(use<Fault::keeps_state>(), 1), ""); }

TEST(ContractChecks, FindWhatIsNotFinite) {
  EXPECT_THAT(breaks_when_run(use<Fault::divides_by_zero>()), HasSubstr("channel 0 at"));
}

// A difference of depths as a weight, or a broken one.
enum class Slip { none, negative, knows_its_run, stores_always, reads_farther };

template <Slip slip>
struct Nearness {
  In<Depth> depth;
  Out<Weight> weight;

  void describe(Describe& d) {
    d.summary("Compares depths.");
    d.in(depth, "depth", "Depth.");
    d.out(weight, "weight", "Weight.");
  }

  void weigh(const quell_input* in, const quell_run& run, float* exponent) const {
    const auto& image = in[depth.index].image[0];
    for (int t = 0; t < run.taps; ++t)
      for (int i = 0; i < run.n; ++i) {
        const float* p = image.plane[0] + run.at + i;
        float e = std::min(std::fabs(*p - p[run.tap[t].offset]), 100.0f);
        if (slip == Slip::negative) e = -e - 1;
        if (slip == Slip::knows_its_run) e += float(run.x) * 1e-3f;
        if (slip == Slip::reads_farther && run.y + run.tap[t].dy + 1 < image.height && run.tap[t].dy > 0)
          e += 0 * p[run.tap[t].offset + image.pitch];
        float& out = exponent[t * run.row + i];
        out = run.store || slip == Slip::stores_always ? e : out + e;
      }
  }
};

template <Slip slip>
std::string breaks() {
  return breaks_when_weighing(Use(type_of<Nearness<slip>>("nearness"), Choices{}));
}

TEST(ContractChecks, PassAnHonestWeight) { EXPECT_EQ(breaks<Slip::none>(), ""); }
TEST(ContractChecks, FindANegativeExponent) { EXPECT_THAT(breaks<Slip::negative>(), HasSubstr("is -1")); }
TEST(ContractChecks, FindADependenceOnRuns) { EXPECT_THAT(breaks<Slip::knows_its_run>(), HasSubstr("in a run of 1")); }
TEST(ContractChecks, FindStoringForAdding) { EXPECT_THAT(breaks<Slip::stores_always>(), HasSubstr("is added where")); }
TEST(ContractChecks, FindAWeightsDishonestReach) { EXPECT_THAT(breaks<Slip::reads_farther>(), HasSubstr("is nan")); }

}  // namespace

}  // namespace quell::test
