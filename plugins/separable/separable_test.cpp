// separable against weighted sums in double precision, and two passes against two-dimensional filters.
#include "tests/support/each_target.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace quell::test {
namespace {

double gauss(int d, double sigma) { return std::exp(-d * d / (2 * sigma * sigma)); }

WeightFormula by_color_formula(const Image& color, double sigma) {
  return [&color, sigma](int x, int y, int dx, int dy) {
    double squared = 0;
    for (int c = 0; c < color.channels(); ++c)
      squared += std::pow(double(color.at(c, x, y)) - color.at(c, x + dx, y + dy), 2);
    return std::exp(-squared / (2 * sigma * sigma));
  };
}

// Σ kernel·w·v / Σ kernel·w along one axis, inside the image; the centre counts fully.
struct PassOracle {
  bool vertical;
  int radius;
  std::function<double(int d)> kernel;
  WeightFormula weight;

  template <class Value>
  double mean(int width, int height, int x, int y, Value value) const {
    double sum = 0, weights = 0;
    for (int d = -radius; d <= radius; ++d) {
      const int dx = vertical ? 0 : d, dy = vertical ? d : 0;
      if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
      const double w = d ? kernel(d) * weight(x, y, dx, dy) : kernel(0);
      sum += w * value(x + dx, y + dy), weights += w;
    }
    return sum / weights;
  }
};

Image both_passes(const Image& image, int radius, float sigma, Node* weight = nullptr) {
  Node across("separable"), down("separable");
  for (Node* node : {&across, &down}) {
    node->set("radius", radius).set("sigma", sigma);
    if (weight) node->in("weights", *weight);
  }
  const auto half = across.in("image", image).run("image");
  return down.set("direction", "vertical").in("image", half).run("image");
}

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{1, 1}, {1, 9}, {17, 3}, {150, 21}};

// A radius of 20 makes 40 taps: a full batch and a remainder.
TEST(Separable, OnePass) {
  for (const auto& [width, height] : kSizes)
    for (const bool vertical : {false, true})
      for (const bool flat : {false, true}) {
        SCOPED_TRACE(testing::Message() << width << "x" << height << " " << vertical << flat);
        const auto image = noise_image(width, height, 3, 141), guide = noise_image(width, height, 3, 142);
        Node by_color("color_weight"), node("separable");
        by_color.set("sigma", 0.4f).in("image", guide);
        node.set("direction", vertical ? "vertical" : "horizontal").set("kernel", flat ? "flat" : "gaussian");
        node.set("radius", 20).set("sigma", 2.5f).in("image", image).in("weights", by_color);
        const PassOracle expected{vertical, 20, [=](int d) { return flat ? 1.0 : gauss(d, 2.5); },
                                  by_color_formula(guide, 0.4)};
        for_each_target([&] {
          // As window: the exponents are floats, and so is the sum.
          const auto value = [&](int c, int x, int y) {
            return expected.mean(width, height, x, y, [&](int u, int v) { return double(image.at(c, u, v)); });
          };
          EXPECT_LE(largest_difference(node.run("image"), value), 5e-6);
        });
      }
}

// Without weights it is a convolution. Radii on both sides of what is summed together, in images with and without an
// inside; the sums' orders differ from the oracle's, so floats round.
TEST(Separable, OnePassWithoutWeights) {
  for (const auto& [width, height] : {Size{1, 1}, {1, 9}, {17, 3}, {300, 40}, {40, 300}})
    for (const int radius : {1, 3, 4, 20, 64})
      for (const bool vertical : {false, true})
        for (const bool flat : {false, true}) {
          SCOPED_TRACE(testing::Message() << width << "x" << height << " radius " << radius << " " << vertical << flat);
          const auto image = noise_image(width, height, 2, 150);
          Node node("separable");
          node.set("direction", vertical ? "vertical" : "horizontal").set("kernel", flat ? "flat" : "gaussian");
          node.set("radius", radius).set("sigma", 7.0f).in("image", image);
          const PassOracle expected{vertical, radius, [=](int d) { return flat ? 1.0 : gauss(d, 7); },
                                    [](int, int, int, int) { return 1.0; }};
          const auto value = [&](int c, int x, int y) {
            return expected.mean(width, height, x, y, [&](int u, int v) { return double(image.at(c, u, v)); });
          };
          for_each_target([&] { EXPECT_LE(largest_difference(node.run("image"), value), 1e-6); });
        }
}

// A broken pixel spoils what it reaches and nothing else, also where many rows or vectors are summed together.
TEST(Separable, NothingReachesFartherThanTheRadius) {
  auto image = noise_image(300, 80, 1, 151);
  image.at(0, 150, 40) = std::nanf("");
  for (const bool vertical : {false, true}) {
    Node node("separable");
    node.set("direction", vertical ? "vertical" : "horizontal").set("radius", 9).in("image", image);
    for_each_target([&] {
      const auto out = node.run("image");
      for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 300; ++x) {
          const bool reached = vertical ? x == 150 && std::abs(y - 40) <= 9 : y == 40 && std::abs(x - 150) <= 9;
          ASSERT_EQ(std::isnan(out.at(0, x, y)), reached) << x << "," << y;
        }
    });
  }
}

TEST(Separable, RadiusFromSigma) {
  const auto image = noise_image(150, 3, 2, 143);
  for (const auto& [sigma, radius] : {std::pair{1.2f, 4}, {0.1f, 1}, {4.0f, 12}, {30.0f, 64}}) {
    Node node("separable"), same("separable");
    const auto from_sigma = node.set("sigma", sigma).in("image", image).run("image");
    EXPECT_TRUE(same_bits(from_sigma, same.set("sigma", sigma).set("radius", radius).in("image", image).run("image")))
        << sigma;
  }
}

// The kernel is a product and so is the sum of its weights inside the image, borders included.
TEST(Separable, TwoPassesAreTheTwoDimensionalGaussian) {
  for (const auto& [width, height] : kSizes) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    const auto image = noise_image(width, height, 3, 144, 0.5f, 1.5f);
    const FilterOracle expected{8, 1, [](int dx, int dy) { return gauss(dx, 3) * gauss(dy, 3); }, {}};
    Node window("window");
    window.set("radius", 8).set("sigma", 3.0f).in("image", image);
    for_each_target([&] {
      const auto separable = both_passes(image, 8, 3.0f);
      EXPECT_LE(largest_difference(separable, [&](int c, int x, int y) { return expected.mean(image, c, x, y); }),
                1e-6);
      const auto square = window.run("image");
      // Twice as much, for the window's 289 taps round too.
      EXPECT_LE(largest_difference(separable, [&](int c, int x, int y) { return double(square.at(c, x, y)); }), 2e-6);
    });
  }
}

// Where the guide changes along x alone, a tap's weight is that of its column, and the filter falls apart again.
TEST(Separable, TwoPassesAreTheBilateralFilterOfOneAxis) {
  const auto image = noise_image(150, 21, 3, 145);
  for (const bool along_x : {true, false}) {
    Image guide(150, 21, 1);
    const auto steps = noise_image(150, 1, 1, 146);
    for (int y = 0; y < 21; ++y)
      for (int x = 0; x < 150; ++x) guide.at(0, x, y) = steps.at(0, along_x ? x : y, 0);
    Node by_guide("color_weight");
    by_guide.set("sigma", 0.3f).in("image", guide);
    const FilterOracle expected{
        6, 1, [](int dx, int dy) { return gauss(dx, 3) * gauss(dy, 3); }, {by_color_formula(guide, 0.3)}};
    for_each_target([&] {
      const auto out = both_passes(image, 6, 3.0f, &by_guide);
      EXPECT_LE(largest_difference(out, [&](int c, int x, int y) { return expected.mean(image, c, x, y); }), 5e-6);
    });
  }
}

// In general it is the approximation that it says: a tap is weighed by way of the corner pixel.
TEST(Separable, TwoPassesWeighByTheCorner) {
  constexpr int kRadius = 5;
  const auto image = noise_image(150, 21, 1, 147), guide = noise_image(150, 21, 3, 148);
  Node by_guide("color_weight");
  by_guide.set("sigma", 0.5f).in("image", guide);
  const auto kernel = [](int d) { return gauss(d, 2); };
  const PassOracle across{false, kRadius, kernel, by_color_formula(guide, 0.5)},
      down{true, kRadius, kernel, by_color_formula(guide, 0.5)};
  for_each_target([&] {
    const auto value = [&](int, int x, int y) {
      return down.mean(150, 21, x, y, [&](int u, int v) {
        return across.mean(150, 21, u, v, [&](int p, int q) { return double(image.at(0, p, q)); });
      });
    };
    EXPECT_LE(largest_difference(both_passes(image, kRadius, 2.0f, &by_guide), value), 5e-6);
  });
}

TEST(Separable, SameBitsForAnyTiles) {
  const auto image = noise_image(333, 240, 3, 149);
  Node by_color("color_weight");
  by_color.in("image", image);
  for (const bool weighed : {false, true})
    for (const char* direction : {"horizontal", "vertical"}) {
      Node node("separable");
      node.set("radius", 64).set("sigma", 30.0f).set("direction", direction).in("image", image);
      if (weighed) node.in("weights", by_color);
      for_each_target([&] {
        const auto whole = node.tiles(0).run("image");
        for (const auto& [rows, columns] : {std::pair{1, 0}, {7, 50}, {140, 129}})
          EXPECT_TRUE(same_bits(whole, node.tiles(rows, columns).run("image"))) << rows << "x" << columns;
      });
    }
}

}  // namespace
}  // namespace quell::test
