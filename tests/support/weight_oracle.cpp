// Weight nodes and filters over them as formulas in double precision.
#include "tests/support/weight_oracle.h"

#include "tests/support/each_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quell::test {

namespace {

constexpr int kRow = QUELL_SEGMENT + 16;

bool inside(int x, int y, int width, int height) { return x >= 0 && y >= 0 && x < width && y < height; }

}  // namespace

std::vector<std::vector<double>> weights_of(Node& weight, int width, int height, int y,
                                            const std::vector<std::pair<int, int>>& offsets, bool paired) {
  const auto& bound = weight.bound();
  const auto pitch = pitch_for(width);
  std::vector<quell_tap> taps;
  for (const auto& [dx, dy] : offsets) taps.push_back({dy * pitch + dx, dx, dy});
  std::vector<std::vector<double>> weights(offsets.size(), std::vector<double>(std::size_t(width)));
  alignas(64) static float stored[QUELL_MAX_TAPS * kRow], added[QUELL_MAX_TAPS * kRow];
  for (int x = 0; x < width; x += QUELL_SEGMENT) {
    const int n = std::min(QUELL_SEGMENT, width - x);
    quell_run run{x, y, n, int(taps.size()), taps.data(), y * pitch + x, kRow, paired, 1};
    std::fill(std::begin(stored), std::end(stored), std::nanf(""));
    std::fill(std::begin(added), std::end(added), 3.0f);
    bound.weigh(bound.instance, bound.resource, bound.in, &run, stored);
    run.store = 0;
    bound.weigh(bound.instance, bound.resource, bound.in, &run, added);
    for (std::size_t t = 0; t < taps.size(); ++t)
      for (int i = 0; i < n; ++i) {
        if (!inside(x + i + taps[t].dx, y + taps[t].dy, width, height)) continue;
        const float e = stored[t * kRow + std::size_t(i)], more = added[t * kRow + std::size_t(i)];
        EXPECT_GE(e, 0.0f);
        EXPECT_TRUE(more == e + 3.0f || std::abs(more - (e + 3.0f)) <= 1e-6f * more) << more << " is not 3 + " << e;
        weights[t][std::size_t(x + i)] = e < 126.0f ? std::exp2(-double(e)) : 0.0;
      }
  }
  return weights;
}

void check_weight(Node& weight, int width, int height, const WeightFormula& formula, double tolerance) {
  const std::vector<std::pair<int, int>> offsets = {{1, 0}, {-1, 0}, {2, 1},   {-2, -1},
                                                    {0, 4}, {0, -4}, {-16, 8}, {16, -8}};
  for_each_target([&] {
    for (const bool paired : {true, false})
      for (int y = 0; y < height; ++y) {
        std::vector<std::pair<int, int>> kept;
        for (std::size_t t = 0; t < offsets.size(); t += 2)
          if (y + offsets[t].second >= 0 && y + offsets[t].second < height && y - offsets[t].second >= 0 &&
              y - offsets[t].second < height)
            kept.insert(kept.end(), {offsets[t], offsets[t + 1]});
        if (!paired) kept.pop_back();
        const auto weights = weights_of(weight, width, height, y, kept, paired);
        for (std::size_t t = 0; t < kept.size(); ++t)
          for (int x = 0; x < width; ++x) {
            const auto [dx, dy] = kept[t];
            if (!inside(x + dx, y + dy, width, height)) continue;
            ASSERT_NEAR(weights[t][std::size_t(x)], formula(x, y, dx, dy), tolerance)
                << "pixel " << x << "," << y << " tap " << dx << "," << dy;
          }
      }
  });
}

double FilterOracle::weight(int x, int y, int dx, int dy) const {
  double w = kernel(dx, dy);
  if (dx || dy)
    for (const auto& formula : weights) w *= formula(x, y, dx * step, dy * step);
  return w;
}

double FilterOracle::mean(const Image& image, int channel, int x, int y) const {
  double sum = 0, total = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const int qx = x + dx * step, qy = y + dy * step;
      if (!inside(qx, qy, image.width(), image.height())) continue;
      const double w = weight(x, y, dx, dy);
      sum += w * image.at(channel, qx, qy), total += w;
    }
  return sum / total;
}

double FilterOracle::variance(const Image& image, int x, int y) const {
  double sum = 0, total = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const int qx = x + dx * step, qy = y + dy * step;
      if (!inside(qx, qy, image.width(), image.height())) continue;
      const double w = weight(x, y, dx, dy);
      sum += w * w * image.at(0, qx, qy), total += w;
    }
  return sum / (total * total);
}

double largest_difference(const Image& image, const std::function<double(int, int, int)>& formula) {
  double largest = 0;
  for (int c = 0; c < image.channels(); ++c)
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const double difference = std::abs(image.at(c, x, y) - formula(c, x, y));
        if (!(difference <= largest)) largest = difference;  // NaN too
        if (std::isnan(difference)) return difference;
      }
  return largest;
}

}  // namespace quell::test
