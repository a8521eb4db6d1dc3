// flip against its formulas in double with whole two-dimensional kernels, and published numbers.
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace quell::test {
namespace {

constexpr double kPi = std::numbers::pi, kPpd = 67.020643;

using Color = std::array<double, 3>;
constexpr double kM[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                             {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                             {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double kWhite[3] = {0.950428545, 1, 1.088900371};
constexpr double kInverse[3][3] = {{3.241003233, -1.537398969, -0.498615882},
                                   {-0.969224252, 1.875929984, 0.041554226},
                                   {0.055639420, -0.204011206, 1.057148977}};

Color times(const double m[3][3], const Color& v) {
  Color out{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) out[r] += m[r][c] * v[c];
  return out;
}
Color opponent(const Color& rgb) {
  const auto xyz = times(kM, rgb);
  const double x = xyz[0] / kWhite[0], y = xyz[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Color lab_of_opponent(const Color& o) {
  const double y = (o[0] + 16) / 116;
  auto rgb = times(kInverse, {kWhite[0] * (y + o[1] / 500), y, kWhite[2] * (y - o[2] / 200)});
  for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
  const auto xyz = times(kM, rgb);
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; };
  const double fx = f(xyz[0] / kWhite[0]), fy = f(xyz[1]), fz = f(xyz[2] / kWhite[2]), l = 116 * fy - 16;
  return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
}
double hyab(const Color& a, const Color& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }
double largest() {
  return std::pow(hyab(lab_of_opponent(opponent({0, 1, 0})), lab_of_opponent(opponent({0, 0, 1}))), 0.7);
}

// A kernel over the square of this radius.
struct Kernel {
  int radius;
  std::vector<double> weight;
  double& at(int x, int y) { return weight[std::size_t((y + radius) * (2 * radius + 1) + x + radius)]; }
  double at(int x, int y) const { return const_cast<Kernel*>(this)->at(x, y); }
};
Kernel kernel(int radius, const std::function<double(int, int)>& f) {
  Kernel k{radius, std::vector<double>(std::size_t((2 * radius + 1) * (2 * radius + 1)))};
  double positive = 0, negative = 0;
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x) {
      const double v = k.at(x, y) = f(x, y);
      (v > 0 ? positive : negative) += std::abs(v);
    }
  for (double& v : k.weight) v /= v > 0 ? positive : negative > 0 ? negative : 1;
  return k;
}
Kernel sensitivity(double a1, double b1, double a2, double b2) {
  return kernel(10, [=](int x, int y) {
    const double z = (x * x + y * y) / (kPpd * kPpd);
    return a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * z / b1) +
           a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * z / b2);
  });
}

using Plane = std::vector<double>;
double convolve(const Plane& p, int width, int height, const Kernel& k, int x, int y, bool transposed = false) {
  double sum = 0;
  for (int j = -k.radius; j <= k.radius; ++j)
    for (int i = -k.radius; i <= k.radius; ++i)
      sum += p[std::size_t(std::clamp(y + j, 0, height - 1) * width + std::clamp(x + i, 0, width - 1))] *
             (transposed ? k.at(j, i) : k.at(i, j));
  return sum;
}

double aces(double v) {
  v = std::min(v, 65536.0);
  return (0.36 * 2.51 * v * v + 0.018 * v) / (0.36 * 2.43 * v * v + 0.354 * v + 0.14);
}

// The map of one exposure; nothing: clamped, without a curve.
std::vector<double> oracle(const Image& test, const Image& reference, double gain, bool curve) {
  const int w = test.width(), h = test.height();
  const auto lightness = sensitivity(1, 0.0047, 0, 1e-5), red_green = sensitivity(1, 0.0053, 0, 1e-5),
             blue_yellow = sensitivity(34.1, 0.04, 13.5, 0.025);
  const double sigma = 0.5 * 0.082 * kPpd;
  const auto gauss = [=](int x, int y) { return std::exp(-(x * x + y * y) / (2 * sigma * sigma)); };
  const auto edge = kernel(9, [=](int x, int y) { return -x * gauss(x, y); });
  const auto point = kernel(9, [=](int x, int y) { return (x * x / (sigma * sigma) - 1) * gauss(x, y); });
  std::array<std::array<Plane, 3>, 2> planes;
  for (std::size_t i = 0; i < 2; ++i)
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        Color rgb;
        for (int c = 0; c < 3; ++c) {
          double v = (i ? reference : test).at(c, x, y);
          if (curve) v = aces(std::clamp(v, 0.0, 65536.0) * gain);
          rgb[std::size_t(c)] = std::clamp(v, 0.0, 1.0);
        }
        const auto o = opponent(rgb);
        for (std::size_t c = 0; c < 3; ++c) planes[i][c].push_back(o[c]);
      }
  std::vector<double> map;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      Color lab[2];
      double edges[2], points[2];
      for (std::size_t i = 0; i < 2; ++i) {
        const auto& p = planes[i];
        lab[i] = lab_of_opponent({convolve(p[0], w, h, lightness, x, y), convolve(p[1], w, h, red_green, x, y),
                                  convolve(p[2], w, h, blue_yellow, x, y)});
        edges[i] = std::hypot(convolve(p[0], w, h, edge, x, y), convolve(p[0], w, h, edge, x, y, true)) / 116;
        points[i] = std::hypot(convolve(p[0], w, h, point, x, y), convolve(p[0], w, h, point, x, y, true)) / 116;
      }
      const double e = std::pow(hyab(lab[0], lab[1]), 0.7), most = largest(), knee = 0.4 * most;
      const double color = e < knee ? 0.95 / knee * e : 0.95 + 0.05 * (e - knee) / (most - knee);
      const double feature =
          std::sqrt(std::max(std::abs(edges[0] - edges[1]), std::abs(points[0] - points[1])) / std::sqrt(2.0));
      map.push_back(std::pow(color, 1 - feature));
    }
  return map;
}

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
// The published pair: sRGB patterns, decoded.
Image reference_pattern() {
  Image image(24, 24, 3);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      const double rgb[3] = {((7 * x + 13 * y) % 32) / 31.0, ((5 * x + 3 * y) % 16) / 15.0, ((x + y) % 8) / 7.0};
      for (int c = 0; c < 3; ++c) image.at(c, x, y) = float(linear(rgb[c]));
    }
  return image;
}
Image test_pattern() {
  Image image(24, 24, 3);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      const double rgb[3] = {((7 * x + 13 * y) % 32) / 31.0, ((5 * x + 3 * y) % 16) / 15.0, ((x + y) % 8) / 7.0};
      for (int c = 0; c < 3; ++c) image.at(c, x, y) = float(linear(std::min(1.0, 0.8 * rgb[c] + 0.1)));
    }
  return image;
}
double mean(const Image& map) {
  double sum = 0;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) sum += map.at(0, x, y);
  return sum / (map.width() * map.height());
}
Image flip(const Image& test, const Image& reference) {
  return Node("flip").in("image", test).in("reference", reference).run("map");
}

TEST(Flip, GivesThePublishedNumbers) {
  const auto reference = reference_pattern(), test = test_pattern();
  for_each_target([&] {
    const auto map = flip(test, reference);
    EXPECT_NEAR(mean(map), 0.18155966, 1e-5);
    EXPECT_NEAR(map.at(0, 0, 0), 0.20370070, 2e-5);
    EXPECT_NEAR(map.at(0, 12, 12), 0.16501288, 2e-5);
    EXPECT_NEAR(map.at(0, 23, 5), 0.21099835, 2e-5);
    EXPECT_NEAR(mean(flip(constant_image(32, 32, 3, 0), constant_image(32, 32, 3, 1))), 0.9673798, 1e-5);
  });
}

TEST(Flip, IsItsFormula) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {43, 37}}) {
    const auto test = noise_image(width, height, 3, 1, -0.1f, 1.2f), reference = noise_image(width, height, 3, 2, 0, 1);
    const auto expected = oracle(test, reference, 1, false);
    for_each_target([&] {
      const auto map = flip(test, reference);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          // Floats through two passes of filters, whose error 116 and 500 multiply.
          ASSERT_NEAR(map.at(0, x, y), expected[std::size_t(y * width + x)], 3e-5) << x << "," << y;
    });
  }
}

TEST(Flip, IsTheWorstOfAllExposures) {
  constexpr int kWidth = 29, kHeight = 21;
  auto reference = noise_image(kWidth, kHeight, 3, 3, 0, 0.2f), test = noise_image(kWidth, kHeight, 3, 4, 0, 0.2f);
  for (int c = 0; c < 3; ++c) reference.at(c, 7, 7) = 40, test.at(c, 8, 7) = 1e6f;
  const auto most = Node("percentile").set("share", 1.0f).in("image", reference).run("value");
  const auto middle = Node("percentile").in("image", reference).run("value");
  const double start = std::log2(2.1188724 / most.at(0, 0, 0)), stop = std::log2(2.1188724 / middle.at(0, 0, 0));
  const int steps = std::max(2, int(std::ceil(stop - start)));
  EXPECT_GE(steps, 7);
  std::vector<double> expected(kWidth * kHeight, 0);
  for (int i = 0; i < steps; ++i) {
    const auto map = oracle(test, reference, std::exp2(start + i * (stop - start) / (steps - 1)), true);
    for (std::size_t p = 0; p < map.size(); ++p) expected[p] = std::max(expected[p], map[p]);
  }
  for_each_target([&] {
    Node node("flip");
    const auto map =
        node.in("image", test).in("reference", reference).in("brightest", most).in("median", middle).run("map");
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        ASSERT_NEAR(map.at(0, x, y), expected[std::size_t(y * kWidth + x)], 1e-4) << x << "," << y;
  });
}

TEST(Flip, TakesBlackReferences) {
  const auto black = constant_image(20, 20, 3, 0), zero = constant_image(1, 1, 1, 0),
             bright = constant_image(1, 1, 1, 50);
  const auto lit = noise_image(20, 20, 3, 4, 0, 100);
  for (const Image* most : {&zero, &bright}) {
    Node node("flip");
    const auto map = node.in("image", lit).in("reference", black).in("brightest", *most).in("median", zero).run("map");
    EXPECT_GT(mean(map), 0.5);
    EXPECT_LE(mean(map), 1);
  }
}

TEST(Flip, IsSymmetricAndNoneOfEqualImages) {
  const auto a = test_pattern(), b = reference_pattern();
  for_each_target([&] {
    const auto ab = flip(a, b), ba = flip(b, a), same = flip(a, a);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        EXPECT_EQ(ab.at(0, x, y), ba.at(0, x, y));
        EXPECT_EQ(same.at(0, x, y), 0.0f);
      }
  });
}

// The kernels that the node is compared with above.
TEST(FlipOracle, HasThePublishedKernels) {
  const auto lightness = sensitivity(1, 0.0047, 0, 1e-5), red_green = sensitivity(1, 0.0053, 0, 1e-5),
             blue_yellow = sensitivity(34.1, 0.04, 13.5, 0.025);
  EXPECT_NEAR(lightness.at(0, 0), 0.148810930, 1e-9);
  EXPECT_NEAR(red_green.at(0, 0), 0.131964410, 1e-9);
  EXPECT_NEAR(blue_yellow.at(0, 0), 0.0200005794, 1e-9);
  EXPECT_NEAR(lightness.at(3, 0), 0.00221476577, 1e-9);
  EXPECT_NEAR(red_green.at(3, 0), 0.00316238498, 1e-9);
  EXPECT_NEAR(blue_yellow.at(3, 0), 0.0111544250, 1e-9);
  EXPECT_NEAR(largest(), 41.276099, 1e-5);
}

}  // namespace
}  // namespace quell::test
