// The history clamp against a direct evaluation of its formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

namespace {

using quell::Image;
using quell::test::constant_image;
using quell::test::for_each_target;
using quell::test::Node;
using quell::test::noise_image;
using quell::test::same_bits;

using Pixel = std::vector<double>;

// How the node is set, and its formula.
struct Rules {
  int radius = 3;
  double k = 1;
  bool range = false, hold_center = false, clip = false, ycocg = false, compress = false;

  Node node() const {
    Node n("temporal_clamp");
    n.set("radius", radius).set("k", float(k)).set("box", range ? "range" : "sigma").set("hold_center", hold_center);
    n.set("pull", clip ? "clip" : "clamp").set("space", ycocg ? "ycocg" : "linear").set("compress", compress);
    return n;
  }

  Pixel at(const Image& image, int x, int y) const {
    Pixel v;
    for (int c = 0; c < image.channels(); ++c) {
      const double value = image.at(c, x, y);
      v.push_back(compress ? std::copysign(std::log1p(std::abs(value)), value) : value);
    }
    if (ycocg) v = {(v[0] + 2 * v[1] + v[2]) / 4, (v[0] - v[2]) / 2, (2 * v[1] - v[0] - v[2]) / 4};
    return v;
  }
  Pixel back(Pixel v) const {
    if (ycocg) {
      const double t = v[0] - v[2];
      v = {t + v[1], v[0] + v[2], t - v[1]};
      for (double& value : v) value = std::max(value, 0.0);
    }
    if (compress)
      for (double& value : v) value = std::copysign(std::expm1(std::abs(value)), value);
    return v;
  }

  struct Box {
    Pixel low, high;
  };
  Box box(const Image& current, int x, int y) const {
    std::vector<Pixel> window;
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, current.height() - 1); ++v)
      for (int u = std::max(x - radius, 0); u <= std::min(x + radius, current.width() - 1); ++u)
        window.push_back(at(current, u, v));
    Box b;
    const Pixel centre = at(current, x, y);
    for (std::size_t c = 0; c < centre.size(); ++c) {
      double mean = 0, squares = 0, least = HUGE_VAL, most = -HUGE_VAL;
      for (const auto& v : window) mean += v[c] / double(window.size());
      for (const auto& v : window) {
        squares += (v[c] - mean) * (v[c] - mean) / double(window.size());
        least = std::min(least, v[c]), most = std::max(most, v[c]);
      }
      const double reach = k * std::sqrt(squares);
      double low = range ? least : mean - reach, high = range ? most : mean + reach;
      if (hold_center) low = std::min(low, centre[c]), high = std::max(high, centre[c]);
      b.low.push_back(low), b.high.push_back(high);
    }
    return b;
  }

  Pixel pulled(Pixel v, const Box& b) const {
    double farthest = 0;
    for (std::size_t c = 0; c < v.size(); ++c)
      farthest = std::max(farthest, std::abs(v[c] - (b.low[c] + b.high[c]) / 2) / ((b.high[c] - b.low[c]) / 2 + 1e-6));
    for (std::size_t c = 0; c < v.size(); ++c) {
      const double middle = (b.low[c] + b.high[c]) / 2;
      if (!clip)
        v[c] = std::clamp(v[c], b.low[c], b.high[c]);
      else if (farthest > 1)
        v[c] = middle + (v[c] - middle) / farthest;
    }
    return v;
  }
};

std::vector<Rules> all_rules() {
  std::vector<Rules> list;
  for (int i = 0; i < 32; ++i) {
    Rules r;
    r.range = i & 1, r.hold_center = i & 2, r.clip = i & 4, r.ycocg = i & 8, r.compress = i & 16;
    list.push_back(r);
  }
  return list;
}

std::string name(const Rules& r) {
  return std::string(r.range ? "range" : "sigma") + (r.hold_center ? " hold" : "") + (r.clip ? " clip" : " clamp") +
         (r.ycocg ? " ycocg" : "") + (r.compress ? " compress" : "");
}

// Means and deviations are taken in double, so what rounds is what converts between spaces: log and exp to a few 1e-7
// of 1 + |x|, which sums and a clip's division pass on.
TEST(TemporalClamp, IsItsFormula) {
  for_each_target([&] {
    for (Rules r : all_rules())
      for (const auto& [width, height, radius, k] : {std::tuple{33, 17, 3, 0.5f}, {17, 3, 1, 1.0f}, {1, 7, 2, 1.0f}}) {
        SCOPED_TRACE(name(r));
        r.radius = radius, r.k = k;
        const bool negative = !r.ycocg;
        const auto current = noise_image(width, height, 3, 1, 0, 2),
                   history = noise_image(width, height, 3, 2, negative ? -1.0f : 0.0f, 4);
        auto node = r.node();
        const auto out = node.in("history", history).in("current", current).run("image");
        int pulled = 0;
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            const Pixel then = r.at(history, x, y), to = r.pulled(then, r.box(current, x, y)), expected = r.back(to);
            for (std::size_t c = 0; c < 3; ++c)
              EXPECT_NEAR(out.at(int(c), x, y), expected[c], 3e-6 * (1 + std::abs(expected[c]))) << x << ',' << y;
            pulled += to != then;
          }
        EXPECT_GT(pulled, width * height / 10);
      }
  });
}

// The result lies in the box, and that of clip on the line between history and the middle of the box.
TEST(TemporalClamp, EndsInTheBox) {
  for_each_target([&] {
    for (const Rules& r : all_rules()) {
      if (r.compress || r.ycocg) continue;  // there the box is not that of the result's channels; see IsItsFormula
      const auto current = noise_image(33, 9, 3, 1), history = noise_image(33, 9, 3, 2, -3, 3);
      auto node = r.node();
      const auto out = node.in("history", history).in("current", current).run("image");
      for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 33; ++x) {
          const auto b = r.box(current, x, y);
          double share = -1;
          for (std::size_t c = 0; c < 3; ++c) {
            const double v = out.at(int(c), x, y), then = history.at(int(c), x, y), middle = (b.low[c] + b.high[c]) / 2;
            EXPECT_GE(v, b.low[c] - 2e-6) << name(r);
            EXPECT_LE(v, b.high[c] + 2e-6) << name(r);
            if (!r.clip || std::abs(then - middle) < 0.1) continue;
            if (share < 0) share = (v - middle) / (then - middle);
            EXPECT_NEAR((v - middle) / (then - middle), share, 1e-5) << name(r);
          }
          EXPECT_LE(share, 1 + 1e-6);
        }
    }
  });
}

TEST(TemporalClamp, LeavesWhatIsInTheBoxAsItIs) {
  for_each_target([&] {
    for (Rules r : all_rules()) {
      r.k = 1e6;
      const auto current = noise_image(33, 9, 3, 1, 0, 10);
      auto history = noise_image(33, 9, 3, 2, 0, 10);
      if (r.range) history = current.copy();  // each pixel of a window lies in its range
      auto node = r.node();
      EXPECT_TRUE(same_bits(node.in("history", history).in("current", current).run("image"), history)) << name(r);
    }
  });
}

// One firefly in a window lets anything pass, unless highlights are compressed.
TEST(TemporalClamp, CompressedHoldsAgainstFireflies) {
  auto current = constant_image(15, 15, 3, 0.5f);
  for (int c = 0; c < 3; ++c) current.at(c, 7, 7) = 1000;
  const auto history = constant_image(15, 15, 3, 30);
  Rules r;
  EXPECT_EQ(r.node().in("history", history).in("current", current).run("image").at(0, 7, 7), 30);
  r.compress = true;
  EXPECT_LT(r.node().in("history", history).in("current", current).run("image").at(0, 7, 7), 4);
}

TEST(TemporalClamp, OfYCoCgWantsThreeChannels) {
  const auto image = constant_image(5, 5, 2, 1);
  try {
    Node("temporal_clamp").set("space", "ycocg").in("history", image).in("current", image).run("image");
    FAIL() << "no error";
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(), "space ycocg takes images of three channels, RGB; 'history' has 2: use space linear");
  }
}

TEST(TemporalClamp, LeavesHistoryAloneWithinAWideRange) {
  for_each_target([&] {
    const auto current = noise_image(17, 5, 2, 1), history = noise_image(17, 5, 2, 2);
    const auto out =
        Node("temporal_clamp").set("k", 1000.0f).in("history", history).in("current", current).run("image");
    for (int c = 0; c < 2; ++c)
      for (int x = 0; x < 17; ++x) EXPECT_EQ(out.at(c, x, 2), history.at(c, x, 2));
  });
}

TEST(TemporalClamp, ReplacesHistoryWhereNothingVaries) {
  for_each_target([&] {
    const auto current = constant_image(17, 5, 3, 0.3f), history = noise_image(17, 5, 3, 2);
    const auto out = Node("temporal_clamp").in("history", history).in("current", current).run("image");
    for (int x = 0; x < 17; ++x) EXPECT_FLOAT_EQ(out.at(1, x, 2), 0.3f);
  });
}

}  // namespace
