// anti_lag against its formula in double precision, and what it must and must not notice.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

double luminance(const Image& image, int x, int y) {
  return 0.2126 * image.at(0, x, y) + 0.7152 * image.at(1, x, y) + 0.0722 * image.at(2, x, y);
}

struct Frames {
  Image current, history, count;
  Frames(int width, int height)
      : current(noise_image(width, height, 3, 61, 0.0f, 2.0f)),
        history(noise_image(width, height, 3, 62, 0.5f, 1.5f)),
        count(width, height, 1) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        count.at(0, x, y) = float((x / 3 + y) % 7) * 1.5f;  // 0 and 1, too
        if (x > width / 2) current.at(1, x, y) += 1.5f;     // a light switched on
      }
  }

  double formula(int radius, double deviations, double strength, int x, int y) const {
    double n = 0, m = 0, h = 0, m2 = 0, h2 = 0;
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, current.height() - 1); ++v)
      for (int u = std::max(x - radius, 0); u <= std::min(x + radius, current.width() - 1); ++u) {
        const double now = luminance(current, u, v), then = count.at(0, u, v) > 1 ? luminance(history, u, v) : now;
        ++n, m += now, h += then, m2 += now * now, h2 += then * then;
      }
    m /= n, h /= n;
    const double s = std::sqrt(std::max(0.0, m2 / n - m * m + h2 / n - h * h) / n), c = count.at(0, x, y);
    const double level = std::max(m, h);
    const double t = level > 0 ? strength * std::max(0.0, std::abs(m - h) - deviations * s) / level : 0;
    return c > 1 ? std::max(1.0, c * (1 - std::min(t, 1.0))) : c;
  }
};

// A variance is a difference of squares: where it is next to nothing its root is off by a thousandth, no more.
TEST(AntiLag, IsItsFormula) {
  for (const auto& [width, height, radius] : {std::tuple{1, 1, 7}, {1, 9, 2}, {17, 3, 3}, {90, 40, 7}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    const Frames f(width, height);
    Node node("anti_lag");
    node.set("radius", radius).set("deviations", 2.0f).set("strength", 0.7f);
    node.in("current", f.current).in("history", f.history).in("count", f.count);
    for_each_target([&] {
      const auto out = node.run("count");
      EXPECT_LE(largest_difference(out, [&](int, int x, int y) { return f.formula(radius, 2, double(0.7f), x, y); }),
                2e-3);
    });
  }
}

TEST(AntiLag, NoiseAloneShortensNothing) {
  const auto current = noise_image(64, 64, 3, 1), history = noise_image(64, 64, 3, 2),
             count = constant_image(64, 64, 1, 9.0f);
  Node node("anti_lag");
  node.set("deviations", 6.0f).in("current", current).in("history", history).in("count", count);
  EXPECT_TRUE(same_bits(node.run("count"), count));
}

TEST(AntiLag, ASwitchedLampShortensAllTheWay) {
  const auto current = noise_image(64, 64, 3, 1, 1.0f, 3.0f), history = noise_image(64, 64, 3, 2),
             count = constant_image(64, 64, 1, 9.0f);
  Node node("anti_lag");
  node.in("current", current).in("history", history).in("count", count);
  EXPECT_TRUE(same_bits(node.run("count"), constant_image(64, 64, 1, 1.0f)));
}

TEST(AntiLag, SameBitsForAnyTiles) {
  const Frames f(333, 60);
  Node node("anti_lag");
  node.set("strength", 0.7f).in("current", f.current).in("history", f.history).in("count", f.count);
  const auto whole = node.run("count");
  for (const auto& [rows, columns] : {std::pair{1, 0}, {7, 50}, {40, 129}})
    EXPECT_TRUE(same_bits(whole, node.tiles(rows, columns).run("count"))) << rows << "x" << columns;
}

}  // namespace
}  // namespace quell::test
