// Shipped spatial graphs and parts over images whose truth is known: what they gain, and what they leave alone.
#include "tests/support/run_graph.h"
#include "tests/support/run_node.h"
#include "tests/support/run_shipped.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <cmath>

namespace quell::test {
namespace {

constexpr int kWidth = 120, kHeight = 64, kEdge = 60;

// Two half planes, a value for each channel and side.
Image halves(const float (&left)[3], const float (&right)[3]) {
  Image image(kWidth, kHeight, 3);
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) image.at(c, x, y) = x < kEdge ? left[c] : right[c];
  return image;
}
Image with_noise(const Image& image, float size, std::uint32_t seed) {
  const auto noise = noise_image(kWidth, kHeight, 3, seed, -size, size);
  Image sum(kWidth, kHeight, 3);
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) sum.at(c, x, y) = image.at(c, x, y) + noise.at(c, x, y);
  return sum;
}
double rms(const Image& a, const Image& b) {
  double sum = 0;
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) sum += std::pow(double(a.at(c, x, y)) - b.at(c, x, y), 2);
  return std::sqrt(sum / (a.channels() * kWidth * kHeight));
}

constexpr char kWavelets[] = R"({
  "quell": 1,
  "inputs": { "color": "radiance", "albedo": "albedo", "normal": "normal", "position": "position" },
  "nodes": { "eaw": { "graph": "quell:eaw.json", "set": { "sigma_color": 2.0, "detail": DETAIL },
                      "in": { "color": "color", "albedo": "albedo", "normal": "normal", "position": "position" } } },
  "outputs": { "color": "eaw" }
})";

Image wavelets(const std::string& detail, const Image& color) {
  std::string text = kWavelets;
  text.replace(text.find("DETAIL"), 6, detail);
  const auto albedo = constant_image(kWidth, kHeight, 3, 1.0f), normal = halves({0, 0, 1}, {1, 0, 0}),
             position = halves({0, 0, 1}, {0, 0, 1});
  auto out = run_graph_text(text, {{"color", {QUELL_RADIANCE, &color}},
                                   {"albedo", {QUELL_ALBEDO, &albedo}},
                                   {"normal", {QUELL_NORMAL, &normal}},
                                   {"position", {QUELL_POSITION, &position}}});
  return std::move(out.at("color"));
}

// Five levels average hundreds of pixels; the wall's edge is one of normals.
TEST(EdgeAvoidingWavelets, TakeNoiseAndKeepEdges) {
  const auto truth = halves({1, 1, 1}, {3, 2, 2}), noisy = with_noise(truth, 0.6f, 201);
  EXPECT_LE(rms(wavelets("[0,0,0,0,0,0,0,0]", noisy), truth), rms(noisy, truth) / 6);
}

TEST(EdgeAvoidingWavelets, AllDetailIsTheInput) {
  const auto noisy = with_noise(halves({1, 1, 1}, {3, 2, 2}), 0.6f, 202);
  EXPECT_LE(rms(wavelets("[1,1,1,1,1,1,1,1]", noisy), noisy), 1e-6);
}

TEST(OutlierRemoval, RemovesFirefliesAndSaysWhatItCost) {
  constexpr char kGraph[] = R"({ "quell": 1, "inputs": { "color": "radiance" },
    "nodes": { "remove": { "graph": "quell:outlier_removal.json", "in": { "color": "color" } } },
    "outputs": { "color": "remove.color", "share": "remove.share_removed", "changed": "remove.pixels_changed" } })";
  const auto truth = with_noise(constant_image(kWidth, kHeight, 3, 1.0f), 0.1f, 203);
  auto spoilt = truth.copy();
  for (int y = 5; y < kHeight; y += 13)
    for (int x = 6; x < kWidth; x += 17)
      for (int c = 0; c < 3; ++c) spoilt.at(c, x, y) = 500;
  const auto out = run_graph_text(kGraph, {{"color", {QUELL_RADIANCE, &spoilt}}});
  EXPECT_LE(rms(out.at("color"), truth), rms(spoilt, truth) / 10);
  // 5 · 7 pixels of 500 among 7680 of 1: 70 % of the light.
  EXPECT_NEAR(out.at("share").at(0, 0, 0), 35 * 500.0 / (35 * 500.0 + 7645), 0.1);
  EXPECT_GE(out.at("changed").at(0, 0, 0), 35.0 / 7680);
}

// What its description promises.
TEST(OutlierRemoval, TakesEveryOtherClamp) {
  for (const char* clamp : {"outlier_rank", "luminance_cap", "percentile_clamp"})
    EXPECT_NO_THROW(shipped_graph("outlier_removal", {{Edit::Kind::swap, std::string("clamp=") + clamp}})) << clamp;
}

TEST(Prefilter, TakesNoiseOfFeaturesAndKeepsTheirEdges) {
  constexpr char kGraph[] = R"({ "quell": 1,
    "inputs": { "albedo_a": "albedo", "albedo_b": "albedo", "normal_a": "normal", "normal_b": "normal" },
    "nodes": { "clean": { "graph": "quell:parts/prefilter.json",
                          "in": { "albedo_a": "albedo_a", "albedo_b": "albedo_b", "normal_a": "normal_a", "normal_b": "normal_b" } } },
    "outputs": { "albedo": "clean.albedo", "normal": "clean.normal" } })";
  const auto albedo = halves({0.7f, 0.2f, 0.2f}, {0.2f, 0.7f, 0.3f}), normal = halves({0, 0, 1}, {1, 0, 0});
  const auto albedo_a = with_noise(albedo, 0.15f, 204), albedo_b = with_noise(albedo, 0.15f, 205),
             normal_a = with_noise(normal, 0.15f, 206), normal_b = with_noise(normal, 0.15f, 207);
  const auto out = run_graph_text(kGraph, {{"albedo_a", {QUELL_ALBEDO, &albedo_a}},
                                           {"albedo_b", {QUELL_ALBEDO, &albedo_b}},
                                           {"normal_a", {QUELL_NORMAL, &normal_a}},
                                           {"normal_b", {QUELL_NORMAL, &normal_b}}});
  // The mean of the halves has √½ of their noise.
  EXPECT_LE(rms(out.at("albedo"), albedo), rms(albedo_a, albedo) * std::sqrt(0.5) / 2.5);
  EXPECT_LE(rms(out.at("normal"), normal), rms(normal_a, normal) * std::sqrt(0.5) / 2.5);
}

// White noise through three levels: the paper's formula says less variance than filtered moments do.
TEST(MomentsLevel, KeepsTheVarianceOfTheNoise) {
  constexpr char kGraph[] = R"({ "quell": 1, "inputs": { "color": "radiance" },
    "nodes": {
      "moments": { "type": "luminance_moments", "in": { "image": "color" } },
      "level0": { "graph": "quell:parts/moments_level.json", "in": { "image": "color", "moments": "moments", "weights": [] },
                  "set": { "step": 1, "sigma_luminance": 1000000 } },
      "level1": { "graph": "quell:parts/moments_level.json", "set": { "step": 2, "sigma_luminance": 1000000 },
                  "in": { "image": "level0.image", "moments": "level0.moments", "weights": [] } } },
    "outputs": { "color": "level1.image", "variance": "level1.variance" } })";
  const auto noisy = with_noise(constant_image(kWidth, kHeight, 3, 1.0f), 0.5f, 208);
  const auto out = run_graph_text(kGraph, {{"color", {QUELL_RADIANCE, &noisy}}});
  // Luminance of the noise: uniform in ±0.5, variance 1/12 a channel.
  const double variance = (0.2126 * 0.2126 + 0.7152 * 0.7152 + 0.0722 * 0.0722) / 12;
  double mean = 0, spread = 0;
  const Image& color = out.at("color");
  for (int y = 12; y < kHeight - 12; ++y)
    for (int x = 12; x < kWidth - 12; ++x) {
      const double n = (kWidth - 24) * (kHeight - 24);
      const double l = 0.2126 * color.at(0, x, y) + 0.7152 * color.at(1, x, y) + 0.0722 * color.at(2, x, y);
      mean += out.at("variance").at(0, x, y) / n, spread += (l - 1) * (l - 1) / n;
    }
  // About the window's own mean: what the two levels leave of the noise, 1.5 %, is missing.
  EXPECT_NEAR(mean / variance, 1 - 0.0152459, 0.05);
  EXPECT_NEAR(spread / variance, 0.0152459, 0.006);
}

}  // namespace
}  // namespace quell::test
