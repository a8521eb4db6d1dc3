// ssim against its formula in double over whole windows, and published numbers.
#include "tests/support/each_target.h"
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace quell::test {
namespace {

struct Similarity {
  double l = 0, cs = 0;
};

// Of one channel around one pixel; the border is repeated.
Similarity similarity(const Image& a, const Image& b, int c, int x, int y) {
  double weights = 0, ua = 0, ub = 0, aa = 0, bb = 0, ab = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (int j = -5; j <= 5; ++j)
      for (int i = -5; i <= 5; ++i) {
        const double w = std::exp(-(i * i + j * j) / (2 * 1.5 * 1.5));
        const int u = std::clamp(x + i, 0, a.width() - 1), v = std::clamp(y + j, 0, a.height() - 1);
        const double p = a.at(c, u, v), q = b.at(c, u, v);
        if (pass == 0)
          weights += w, ua += w * p, ub += w * q;
        else
          aa += w * (p - ua) * (p - ua), bb += w * (q - ub) * (q - ub), ab += w * (p - ua) * (q - ub);
        if (pass == 0 && i == 5 && j == 5) ua /= weights, ub /= weights;
      }
  aa /= weights, bb /= weights, ab /= weights;
  const double c1 = 1e-4, c2 = 9e-4;
  return {(2 * ua * ub + c1) / (ua * ua + ub * ub + c1), (2 * ab + c2) / (aa + bb + c2)};
}

// A flat part, a smooth part and noise.
Image picture(int width, int height, int channels, std::uint32_t seed) {
  auto image = noise_image(width, height, channels, seed);
  for (int c = 0; c < channels; ++c)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (x < width / 3) image.at(c, x, y) = 0.02f;
        if (x > 2 * width / 3) image.at(c, x, y) = 0.5f + 0.4f * std::sin(0.3f * float(x + y + c));
      }
  return image;
}

TEST(Ssim, IsItsFormula) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {61, 33}})
    for (const int channels : {1, 3}) {
      const auto a = picture(width, height, channels, 1), noise = noise_image(width, height, channels, 9);
      auto b = a.copy();
      for (int c = 0; c < channels; ++c)
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) b.at(c, x, y) = 0.7f * b.at(c, x, y) + 0.3f * noise.at(c, x, y);
      for_each_target([&] {
        Node node("ssim");
        const auto out = node.in("image", a).in("reference", b).run();
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            double ssim = 0, cs = 0;
            for (int c = 0; c < channels; ++c) {
              const auto s = similarity(a, b, c, x, y);
              ssim += s.l * s.cs / channels, cs += s.cs / channels;
            }
            // Doubles but for the sum over channels, each of which is rounded.
            ASSERT_NEAR(out[0].at(0, x, y), ssim, 3e-7) << x << "," << y;
            ASSERT_NEAR(out[1].at(0, x, y), cs, 3e-7) << x << "," << y;
            const bool inside = x >= 5 && y >= 5 && x < width - 5 && y < height - 5;
            ASSERT_EQ(out[2].at(0, x, y), inside ? 1.0f : 0.0f);
          }
      });
    }
}

TEST(Ssim, OfConstantsIsTheirLuminance) {
  const auto a = constant_image(24, 16, 3, 0.2f), b = constant_image(24, 16, 3, 0.4f);
  for_each_target([&] {
    Node node("ssim");
    EXPECT_NEAR(node.in("image", a).in("reference", b).run("map").at(0, 12, 8), 0.80009995, 1e-7);
  });
}

TEST(Ssim, IsSymmetricAndOneOfEqualImages) {
  const auto a = picture(40, 20, 3, 3), b = picture(40, 20, 3, 4);
  for_each_target([&] {
    Node same("ssim"), one("ssim"), other("ssim");
    const auto equal = same.in("image", a).in("reference", a).run("map");
    const auto ab = one.in("image", a).in("reference", b).run("map"),
               ba = other.in("image", b).in("reference", a).run("map");
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 40; ++x) {
        EXPECT_NEAR(equal.at(0, x, y), 1, 1e-6);
        EXPECT_NEAR(ab.at(0, x, y), ba.at(0, x, y), 1e-6);  // rounded in another order
        EXPECT_LE(std::abs(ab.at(0, x, y)), 1 + 1e-6);
      }
  });
}

}  // namespace
}  // namespace quell::test
