// The shipped metrics against their formulas, over all that they are made of.
#include "core/graph/write.h"
#include "core/lab/metric.h"
#include "tests/support/judge.h"
#include "tests/support/paths.h"
#include "tests/support/picture_metrics.h"
#include "tests/support/run_node.h"
#include "tests/support/scratch.h"

#include <quell/types.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace quell::test {
namespace {

constexpr int kWidth = 61, kHeight = 37;

Image pictures(std::uint32_t seed, float high = 3) { return noise_image(kWidth, kHeight, 3, seed, 0, high); }

// The mean over pixels and channels of f(x, y).
template <class F>
double mean_of(const Image& x, const Image& y, F f) {
  double sum = 0;
  for (int c = 0; c < x.channels(); ++c)
    for (int v = 0; v < x.height(); ++v)
      for (int u = 0; u < x.width(); ++u) sum += f(double(x.at(c, u, v)), double(y.at(c, u, v)));
  return sum / (double(x.width()) * x.height() * x.channels());
}

TEST(ShippedMetrics, Load) {
  const auto graphs = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs";
  for (const auto& name : installed_metrics(graphs)) {
    Diagnostics diagnostics;
    const auto metric = load_metric(name, graphs, registry(), diagnostics);
    ASSERT_TRUE(metric) << diagnostics.format();
    EXPECT_EQ(diagnostics.format(), "") << name;
    EXPECT_FALSE(metric->title.empty() || metric->about.empty()) << name;
  }
}

TEST(ShippedMetrics, AreMetricsStillWhenWrittenOut) {
  const auto graphs = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs";
  const Scratch scratch;
  for (const auto& name : installed_metrics(graphs)) {
    Diagnostics diagnostics;
    const auto metric = load_metric(name, graphs, registry(), diagnostics);
    ASSERT_TRUE(metric);
    const auto file = scratch.path(name + ".json");
    std::ofstream(file) << write_graph(metric->graph, graphs, metric->key).text;
    const auto again = load_metric(file, graphs, registry(), diagnostics);
    ASSERT_TRUE(again) << diagnostics.format();
    EXPECT_EQ(fingerprint(again->graph), fingerprint(metric->graph)) << name;
    EXPECT_EQ(again->key.higher_is_better, metric->key.higher_is_better) << name;
    EXPECT_EQ(again->key.unit, metric->key.unit) << name;
    EXPECT_EQ(again->key.perfect, metric->key.perfect) << name;
  }
}

TEST(ShippedMetrics, ArePointwiseFormulas) {
  const auto x = pictures(1), y = pictures(2);
  const double mse = mean_of(x, y, [](double a, double b) { return (a - b) * (a - b); });
  // Maps and values are floats; sums are not.
  EXPECT_NEAR(judge("mse", x, y).value, mse, 1e-6 * mse);
  EXPECT_NEAR(judge("rmse", x, y).value, std::sqrt(mse), 1e-6 * std::sqrt(mse));
  EXPECT_NEAR(judge("relmse", x, y).value,
              mean_of(x, y, [](double a, double b) { return (a - b) * (a - b) / (b * b + 0.01); }), 1e-4);
  EXPECT_NEAR(judge("mrse", x, y).value,
              mean_of(x, y, [](double a, double b) { return (a - b) * (a - b) / std::pow(b + 0.01, 2); }), 2e-2);
  EXPECT_NEAR(judge("smape", x, y).value,
              mean_of(x, y, [](double a, double b) { return std::abs(a - b) / (a + b + 0.01); }), 1e-6);
  EXPECT_NEAR(judge("mae", x, y).value, mean_of(x, y, [](double a, double b) { return std::abs(a - b); }), 1e-6);
  EXPECT_NEAR(judge("mape", x, y).value, mean_of(x, y, [](double a, double b) { return std::abs(a - b) / (b + 0.01); }),
              1e-4);
  EXPECT_EQ(judge("mse", x, y).pixels, kWidth * kHeight);
}

TEST(ShippedMetrics, OfAConstantOffsetAreItsSquare) {
  const auto y = pictures(3);
  auto x = y.copy();
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) x.at(c, u, v) += 0.125f;
  EXPECT_NEAR(judge("mse", x, y).value, 0.015625, 1e-7);
  EXPECT_NEAR(judge("rmse", x, y).value, 0.125, 1e-7);
}

TEST(ShippedMetrics, TrimTheWorstPixels) {
  const auto y = pictures(4);
  auto x = pictures(5);
  const double clean = judge("relmse_trimmed", x, y).value;
  x.at(0, 10, 10) = 1e6f, x.at(1, 40, 20) = 1e6f;  // two pixels, one in a thousand of 2257
  EXPECT_GT(judge("relmse", x, y).value, 1e6);
  EXPECT_NEAR(judge("relmse_trimmed", x, y).value, clean, 0.1 * clean);
  EXPECT_EQ(judge("relmse_trimmed", x, y).pixels, kWidth * kHeight - 2);
}

TEST(ShippedMetrics, AgreeWithThoseOfTheTests) {
  const auto x = pictures(6), a = pictures(7), b = pictures(8);
  EXPECT_NEAR(judge("psnr_unbiased", x, a, b).value, psnr(x, {a, b}), 1e-4);
  EXPECT_NEAR(judge("relmse_unbiased", x, a, b).value, relative_error(x, {a, b}), 1e-5);
  EXPECT_NEAR(judge("mse_unbiased", x, a, b).value,
              mean_of(x, a, [](double p, double q) { return p * p - p * q; }) +
                  mean_of(a, b, [](double p, double q) { return p * q; }) -
                  mean_of(x, b, [](double p, double q) { return p * q; }),
              1e-6);
}

// Motion lies between pixels, so that all four have a share: the tests' own flicker wants the four even where one has
// none.
TEST(ShippedMetrics, FlickerIsThatOfTheTests) {
  const auto first = pictures(9), second = pictures(10), motion = [] {
    Image m(kWidth, kHeight, 2);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) m.at(0, x, y) = float(x / 20) - 0.75f, m.at(1, x, y) = float(y / 15) - 0.5f;
    return m;
  }();
  Image id(kWidth, kHeight, 1), id_before(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      id.bits(0, y)[x] = std::uint32_t(x / 13), id_before.bits(0, y)[x] = std::uint32_t((x + 3) / 13);
  const auto frame = [&](const Image& image, const Image& object) {
    return JudgedFrame{
        {"image", {QUELL_RADIANCE, &image}}, {"motion", {QUELL_MOTION, &motion}}, {"id", {QUELL_ID, &object}}};
  };
  const auto verdicts = judge("flicker", {frame(first, id_before), frame(second, id)});
  EXPECT_EQ(verdicts.at(0).pixels, 0) << "the first frame has no number";
  EXPECT_GT(verdicts.at(1).pixels, 500);
  EXPECT_LT(verdicts.at(1).pixels, kWidth * kHeight);
  const double expected = flicker(second, first, motion, id, id_before);
  EXPECT_NEAR(verdicts.at(1).value, expected, 1e-5 * expected);
}

// The published pair of sRGB patterns, decoded.
Image pattern(bool test) {
  Image image(24, 24, 3);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      const double rgb[3] = {((7 * x + 13 * y) % 32) / 31.0, ((5 * x + 3 * y) % 16) / 15.0, ((x + y) % 8) / 7.0};
      for (int c = 0; c < 3; ++c) {
        const double v = test ? std::min(1.0, 0.8 * rgb[c] + 0.1) : rgb[c];
        image.at(c, x, y) = float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
      }
    }
  return image;
}

TEST(ShippedMetrics, GivePublishedFlip) {
  const auto verdict = judge("flip", pattern(true), pattern(false));
  EXPECT_NEAR(verdict.value, 0.18155966, 1e-5);
  EXPECT_NEAR(verdict.map.at(0, 23, 5), 0.21099835, 2e-5);
  const auto black = constant_image(30, 30, 3, 0), white = constant_image(30, 30, 3, 1);
  EXPECT_NEAR(judge("flip", black, white).value, 0.9673798, 1e-5);
}

// Quantiles of the map, each pixel as heavy as its error.
TEST(ShippedMetrics, PoolFlip) {
  for (const std::string name : {"flip", "hdr_flip"}) {
    const auto map = judge(name, pattern(true), pattern(false)).map;
    std::vector<double> errors;
    double all = 0;
    for (int y = 0; y < map.height(); ++y)
      for (int x = 0; x < map.width(); ++x) errors.push_back(map.at(0, x, y)), all += map.at(0, x, y);
    std::ranges::sort(errors);
    const auto weighted = [&](double share) {
      double sum = 0;
      return *std::ranges::find_if(errors, [&](double e) { return (sum += e) > share * all; });
    };
    const auto pooled = [&](const std::string& how, std::vector<Edit> edits = {}) {
      const auto verdict = judge(name + how, pattern(true), pattern(false), std::move(edits));
      EXPECT_EQ(verdict.pixels, map.width() * map.height());
      return verdict.value;
    };
    EXPECT_EQ(pooled("_max"), errors.back());
    EXPECT_EQ(pooled("_median"), weighted(0.5));
    EXPECT_EQ(pooled("_median", {{Edit::Kind::set, "share=0.25"}}), weighted(0.25));
    EXPECT_NE(weighted(0.5), errors[errors.size() / 2]);
  }
}

// 0.2 and 0.4 as an sRGB display shows them.
TEST(ShippedMetrics, GivePublishedSsim) {
  const auto decoded = [](double v) { return float(std::pow((v + 0.055) / 1.055, 2.4)); };
  const auto x = constant_image(200, 170, 3, decoded(0.2)), y = constant_image(200, 170, 3, decoded(0.4));
  EXPECT_NEAR(judge("ssim", x, y).value, 0.80009995, 2e-6);
  EXPECT_EQ(judge("ssim", x, y).pixels, 190 * 160);
  EXPECT_NEAR(judge("ssim_luma", x, y).value, 0.80009995, 2e-6);
  EXPECT_EQ(judge("ssim_luma", x, y).pixels, 190 * 160);
  // All contrasts of constants are 1, so the coarsest scale alone says something.
  EXPECT_NEAR(judge("ms_ssim", x, y).value, std::pow(0.80009995, 0.1333), 2e-6);
  EXPECT_EQ(judge("ms_ssim", x, y).pixels, 3 * 1);
  EXPECT_EQ(judge("ms_ssim", pictures(1), pictures(2)).pixels, 0) << "too small for five scales";
}

TEST(ShippedMetrics, OfADisplayAreTakenBehindItsCurve) {
  const auto x = pictures(21, 1.2f), y = pictures(22, 1.2f);
  const auto srgb = [](double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; };
  const double mse =
      mean_of(x, y, [&](double a, double b) { return std::pow(srgb(std::min(a, 1.0)) - srgb(std::min(b, 1.0)), 2); });
  EXPECT_NEAR(judge("psnr_ldr", x, y).value, -10 * std::log10(mse), 1e-4);
  const double linear = mean_of(x, y, [](double a, double b) { return (a - b) * (a - b); });
  std::vector<double> bright;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      bright.push_back(0.2126 * y.at(0, u, v) + 0.7152 * y.at(1, u, v) + 0.0722 * y.at(2, u, v));
  std::ranges::sort(bright);
  const double peak = bright[std::size_t(0.999 * double(bright.size()))];
  EXPECT_NEAR(judge("psnr_hdr", x, y).value, 10 * std::log10(peak * peak / linear), 1e-4);
}

TEST(ShippedMetrics, OfPuDoNotDependOnExposure) {
  const auto x = pictures(23), y = pictures(24);
  auto x16 = x.copy(), y16 = y.copy();
  for (int c = 0; c < 3; ++c)
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) x16.at(c, u, v) *= 16, y16.at(c, u, v) *= 16;
  EXPECT_NEAR(judge("psnr_pu", x, y).value, judge("psnr_pu", x16, y16).value, 1e-3);
}

// By whole windows in double. Luma of encoded values, not of light.
TEST(ShippedMetrics, SsimOfLumaIsThatOfTheGreyPicture) {
  constexpr int kSize = 24;
  const auto x = noise_image(kSize, kSize, 3, 25, 0, 1.2f), y = noise_image(kSize, kSize, 3, 26, 0, 1.2f);
  const auto srgb = [](double v) {
    v = std::min(v, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  };
  const auto luma = [&](const Image& i, int u, int v) {
    return 0.299 * srgb(i.at(0, u, v)) + 0.587 * srgb(i.at(1, u, v)) + 0.114 * srgb(i.at(2, u, v));
  };
  double sum = 0;
  for (int cy = 5; cy < kSize - 5; ++cy)
    for (int cx = 5; cx < kSize - 5; ++cx) {
      double w = 0, p = 0, q = 0, pp = 0, qq = 0, pq = 0;
      for (int v = cy - 5; v <= cy + 5; ++v)
        for (int u = cx - 5; u <= cx + 5; ++u) {
          const double g = std::exp(-((u - cx) * (u - cx) + (v - cy) * (v - cy)) / 4.5), a = luma(x, u, v),
                       b = luma(y, u, v);
          w += g, p += g * a, q += g * b, pp += g * a * a, qq += g * b * b, pq += g * a * b;
        }
      p /= w, q /= w;
      const double sp = pp / w - p * p, sq = qq / w - q * q, spq = pq / w - p * q;
      sum += (2 * p * q + 1e-4) / (p * p + q * q + 1e-4) * (2 * spq + 9e-4) / (sp + sq + 9e-4);
    }
  const auto verdict = judge("ssim_luma", x, y);
  // The display's curve is one of floats, good to 1e-6 or so.
  EXPECT_NEAR(verdict.value, sum / ((kSize - 10) * (kSize - 10)), 1e-5);
  EXPECT_GT(std::abs(verdict.value - judge("ssim", x, y).value), 1e-3);
}

TEST(ShippedMetrics, SsimOfLumaDoesNotSeeHue) {
  const auto y = constant_image(30, 30, 3, 1);
  auto red = y.copy(), green = y.copy();
  for (int v = 0; v < 30; ++v)
    for (int u = 0; u < 30; ++u) red.at(0, u, v) = 0, green.at(0, u, v) = green.at(1, u, v) = 0;
  EXPECT_LT(judge("ssim", red, y).value, judge("ssim_luma", red, y).value) << "0.299 of three thirds is missing";
  EXPECT_GT(judge("ssim", green, y).value, judge("ssim_luma", green, y).value) << "0.886 of three thirds";
}

// Each metric that knows a perfect number gives it to an image that is its reference.
TEST(ShippedMetrics, ArePerfectOfTheReferenceItself) {
  const auto graphs = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs";
  // The light rises, for those that judge how a picture follows.
  const auto first = noise_image(180, 170, 3, 31), second = noise_image(180, 170, 3, 32, 0, 3);
  const auto normal = normal_image(180, 170, 4), depth = noise_image(180, 170, 1, 5, 1, 5);
  auto motion = constant_image(180, 170, 2, 0);
  for (int x = 0; x < 180; ++x) motion.at(0, x, 3) = 200, motion.at(1, x, 5) = -1;
  const auto frame = [&](const Image& image) {
    JudgedFrame f;
    for (const char* role : {"image", "reference", "reference_a", "reference_b"}) f[role] = {QUELL_RADIANCE, &image};
    f["motion"] = {QUELL_MOTION, &motion}, f["normal"] = {QUELL_NORMAL, &normal}, f["depth"] = {QUELL_DEPTH, &depth};
    return f;
  };
  for (const auto& name : installed_metrics(graphs)) {
    Diagnostics diagnostics;
    const auto metric = load_metric(name, graphs, registry(), diagnostics);
    ASSERT_TRUE(metric);
    std::vector<Edit> edits;
    if (name == "lag") edits.push_back({Edit::Kind::set, "window=1"});  // its number comes where the window ends
    const auto verdicts = judge(name, {frame(first), frame(second)}, std::move(edits));
    EXPECT_GT(verdicts.at(1).pixels, 0) << name;
    const double value = verdicts.at(1).value;
    EXPECT_NEAR(value, metric->key.perfect.value_or(value), 1e-6) << name;
  }
}

TEST(ShippedMetrics, AreSymmetricWhereTheyShouldBe) {
  const auto x = noise_image(180, 170, 3, 33), y = noise_image(180, 170, 3, 34);
  for (const char* name :
       {"mse", "rmse", "mae", "smape", "psnr_ldr", "ssim", "ssim_luma", "ms_ssim", "flip", "flip_median"}) {
    const double xy = judge(name, x, y).value, yx = judge(name, y, x).value;
    EXPECT_NEAR(xy, yx, 1e-6 * std::max(1.0, std::abs(xy))) << name;
  }
  for (const char* name : {"smape", "flip", "hdr_flip"}) {
    const double value = judge(name, x, constant_image(180, 170, 3, 1e4f)).value;
    EXPECT_GT(value, 0.5) << name;
    EXPECT_LE(value, 1) << name;
  }
}

// Frames over time, with motion (dx, dy) in each pixel.
std::vector<Verdict> judge_film(const std::string& metric, const std::vector<Image>& images,
                                const std::vector<Image>& references, float dx, float dy) {
  auto motion = constant_image(images[0].width(), images[0].height(), 2, 0);
  for (int y = 0; y < motion.height(); ++y)
    for (int x = 0; x < motion.width(); ++x) motion.at(0, x, y) = dx, motion.at(1, x, y) = dy;
  std::vector<JudgedFrame> frames;
  for (std::size_t i = 0; i < images.size(); ++i)
    frames.push_back({{"image", {QUELL_RADIANCE, &images[i]}},
                      {"reference", {QUELL_RADIANCE, &references[i]}},
                      {"motion", {QUELL_MOTION, &motion}}});
  return judge(metric, frames);
}

constexpr const char* kTemporal[] = {"temporal_mse", "temporal_error", "excess_flicker",
                                     "tderiv_l1",    "tpsnr",          "flicker"};

TEST(TemporalMetrics, SeeNothingInAStillPicture) {
  std::vector<Image> still, other;
  for (int i = 0; i < 3; ++i) still.push_back(pictures(41)), other.push_back(pictures(42));
  for (const char* name : kTemporal) {
    const auto verdicts = judge_film(name, still, other, 0, 0);
    EXPECT_EQ(verdicts.at(0).pixels, 0) << name;
    for (const std::size_t i : {1u, 2u}) {
      EXPECT_EQ(verdicts.at(i).pixels, kWidth * kHeight) << name;
      EXPECT_EQ(verdicts.at(i).value, std::string(name) == "tpsnr" ? 1000.0 : 0.0) << name;
    }
  }
}

// A window that moves over one large picture by whole pixels.
TEST(TemporalMetrics, SeeNothingInAPan) {
  const auto large = noise_image(90, 80, 3, 43, 0, 1), other = noise_image(90, 80, 3, 44, 0, 1);
  const auto cut = [](const Image& from, int x0, int y0) {
    Image part(kWidth, kHeight, 3);
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y) std::copy_n(from.row(c, y + y0) + x0, kWidth, part.row(c, y));
    return part;
  };
  std::vector<Image> images, references;
  for (int i = 0; i < 3; ++i)
    images.push_back(cut(large, 3 * i, 2 * i)), references.push_back(cut(other, 3 * i, 2 * i));
  for (const char* name : kTemporal) {
    const auto verdicts = judge_film(name, images, references, 3, 2);
    EXPECT_EQ(verdicts.at(2).pixels, (kWidth - 3) * (kHeight - 2)) << name;
    EXPECT_EQ(verdicts.at(2).value, std::string(name) == "tpsnr" ? 1000.0 : 0.0) << name;
  }
}

// Independent noise of variance s² in each frame makes differences of variance 2 s².
TEST(TemporalMetrics, MeasureNoise) {
  std::vector<Image> noisy, clean;
  const float half_width = 0.3f;
  const double variance = double(half_width) * double(half_width) / 3;
  for (std::uint32_t i = 0; i < 2; ++i) {
    noisy.push_back(noise_image(256, 256, 3, 51 + 7 * i, 1 - half_width, 1 + half_width));
    clean.push_back(constant_image(256, 256, 3, 1));
  }
  // The mean of 196608 squares whose own standard deviation is about as large as they are: half a percent.
  EXPECT_NEAR(judge_film("temporal_mse", noisy, clean, 0, 0).at(1).value, 2 * variance, 0.01 * variance);
  // Of a difference of two uniform numbers the mean size is a third of their range, and luminance has one channel here.
  std::vector<Image> grey;
  for (const auto& image : noisy) {
    auto& g = grey.emplace_back(image.copy());
    for (int c = 1; c < 3; ++c)
      for (int y = 0; y < g.height(); ++y) std::copy_n(g.row(0, y), g.width(), g.row(c, y));
  }
  EXPECT_NEAR(judge_film("temporal_error", grey, clean, 0, 0).at(1).value, 2 * half_width / 3, 0.01 * half_width);
  EXPECT_NEAR(judge_film("excess_flicker", noisy, clean, 0, 0).at(1).value, 2 * variance, 0.01 * variance);
  EXPECT_NEAR(judge_film("excess_flicker", clean, noisy, 0, 0).at(1).value, -2 * variance, 0.01 * variance);
  EXPECT_EQ(judge_film("excess_flicker", noisy, noisy, 0, 0).at(1).value, 0);
}

// Errors of 1 within a region and of 2 outside it.
TEST(RegionMetrics, SeeTheirRegionAlone) {
  const auto reference = constant_image(kWidth, kHeight, 3, 1);
  const auto in_region = [&](const std::function<bool(int, int)>& region) {
    auto image = reference.copy();
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) image.at(c, x, y) += region(x, y) ? 1.0f : 2.0f;
    return image;
  };
  const auto expect = [&](const Verdict& v, int pixels, const char* name) {
    EXPECT_EQ(v.pixels, pixels) << name;
    EXPECT_NEAR(v.value, 1 / 1.01, 1e-6) << name;
  };
  // The right 11 columns come from outside, and the 4 rows below row 10 of object 2 show what object 1 hid.
  auto motion = constant_image(kWidth, kHeight, 2, 0);
  Image id(kWidth, kHeight, 1), id_before(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (x >= 50) motion.at(0, x, y) = 20;
      id.bits(0, y)[x] = y < 10 ? 1 : 2, id_before.bits(0, y)[x] = y < 14 ? 1 : 2;
    }
  const auto fresh = in_region([](int x, int y) { return x >= 50 || (y >= 10 && y < 14); });
  const auto frame = [&](const Image& image, const Image& object) {
    return JudgedFrame{{"image", {QUELL_RADIANCE, &image}},
                       {"reference", {QUELL_RADIANCE, &reference}},
                       {"motion", {QUELL_MOTION, &motion}},
                       {"id", {QUELL_ID, &object}}};
  };
  const auto new_pixels = judge("relmse_disoccluded", {frame(fresh, id_before), frame(fresh, id)});
  EXPECT_EQ(new_pixels.at(0).pixels, 0) << "of the first frame all is new, and no number says more";
  expect(new_pixels.at(1), 11 * kHeight + 4 * 50, "relmse_disoccluded");
  const auto moving = in_region([](int x, int) { return x >= 50; });
  expect(judge("relmse_moving", {frame(moving, id)}).at(0), 11 * kHeight, "relmse_moving");
  const auto beside = in_region([](int, int y) { return y == 9 || y == 10; });
  expect(judge("relmse_edges", {frame(beside, id)}).at(0), 2 * kWidth, "relmse_edges");
}

TEST(RegionMetrics, FindTheDark) {
  auto reference = constant_image(40, 20, 3, 1);
  auto image = constant_image(40, 20, 3, 4);
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 11; ++x) reference.at(c, x, y) = 0.1f, image.at(c, x, y) = 0.2f;  // more than a quarter
  const auto dark = judge("relmse_dark", image, reference);
  EXPECT_EQ(dark.pixels, 11 * 20) << "pixels as bright as the limit belong to it";
  EXPECT_NEAR(dark.value, 0.01 / 0.02, 1e-6);
}

}  // namespace
}  // namespace quell::test
