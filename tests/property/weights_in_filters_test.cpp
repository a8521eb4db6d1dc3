// Every weight node works in every filter that takes weights: found from the tables alone, so that a new plugin of
// either kind is held to this by being there.
#include "tests/support/altered_frames.h"
#include "tests/support/run_node.h"
#include "tests/support/typical_input.h"
#include "tests/support/weight_oracle.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

namespace quell::test {
namespace {

constexpr int kWidth = 150, kHeight = 23;

const quell_port* weights_port(const NodeType& type) {
  for (const auto& port : type.inputs())
    if (port.type == QUELL_WEIGHT) return &port;
  return nullptr;
}

std::vector<std::string> names(bool (*wanted)(const NodeType&)) {
  std::vector<std::string> list;
  for (const auto* type : registry().all())
    if (wanted(*type)) list.emplace_back(type->name());
  return list;
}
std::vector<std::string> filters() {
  return names([](const NodeType& t) { return weights_port(t) != nullptr; });
}
std::vector<std::string> weights() {
  return names([](const NodeType& t) { return t.is_weight(); });
}

// A node with all ports wired to typical images, which it owns. `smooth` has guides without noise, so that neighbours
// are alike enough to count.
class Wired {
 public:
  using Alter = std::function<Image(const Image&, int type)>;
  Wired(const std::string& type, bool smooth, bool constant = false, const Alter& alter = {}) : node_(type) {
    std::uint32_t seed = 5;
    for (const auto& port : node_.type().inputs()) {
      if (port.type == QUELL_WEIGHT) continue;
      const int image_type = port.type == QUELL_ANY ? int(QUELL_RADIANCE) : port.type;
      auto& image = images_.emplace_back(typical_input(image_type, kWidth, kHeight, ++seed));
      if (image_type == QUELL_NORMAL && smooth) image = normal_image(kWidth, kHeight, 3);
      if (image_type == QUELL_POSITION && smooth) image = noise_image(kWidth, kHeight, 3, 4, 5.0f, 5.1f);
      if (image_type == QUELL_RADIANCE && smooth) image = noise_image(kWidth, kHeight, 3, 7, 0.5f, 1.5f);
      if (image_type == QUELL_DEPTH && smooth) image = noise_image(kWidth, kHeight, 1, 8, 5.0f, 5.01f);
      if (image_type == QUELL_COUNT) image.fill(1);  // all pixels young: all are filtered
      if (constant && image_type == QUELL_RADIANCE) image.fill(0.75f);
      if (alter) image = alter(image, image_type);
      node_.in(port.name, image);
    }
  }
  Node& node() { return node_; }
  const Image& image() const { return images_.front(); }

 private:
  std::deque<Image> images_;
  Node node_;
};

class WeightsInFilters : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::string filter() const { return std::get<0>(GetParam()); }
  std::string weight() const { return std::get<1>(GetParam()); }
  const char* port() const { return weights_port(*registry().find(filter()))->name; }
};

TEST_P(WeightsInFilters, LeaveAConstantImageAlone) {
  Wired w(weight(), false), f(filter(), false, true);
  const auto out = f.node().in(port(), w.node()).run();
  // Hundreds of taps, each of which may round.
  EXPECT_LE(largest_difference(out[0], [](int, int, int) { return 0.75; }), 5e-6);
}

TEST_P(WeightsInFilters, KeepToTheRangeOfTheImage) {
  Wired w(weight(), false), f(filter(), false);
  const auto out = f.node().in(port(), w.node()).run();
  for (int c = 0; c < out[0].channels(); ++c) {
    float low = HUGE_VALF, high = -HUGE_VALF;
    for (int y = 0; y < kHeight; ++y) {
      const auto [a, b] = std::minmax_element(f.image().row(c, y), f.image().row(c, y) + kWidth);
      low = std::min(low, *a), high = std::max(high, *b);
    }
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        ASSERT_GE(out[0].at(c, x, y), low - 1e-5f * std::abs(low));
        ASSERT_LE(out[0].at(c, x, y), high + 1e-5f * std::abs(high));
      }
  }
}

// The weight must matter, and not by shutting everything out.
TEST_P(WeightsInFilters, ChangeTheResult) {
  Wired w(weight(), true), f(filter(), true), plain(filter(), true);
  const auto out = f.node().in(port(), w.node()).run();
  const auto without = plain.node().run();
  EXPECT_GT(largest_difference(out[0], [&](int c, int x, int y) { return double(without[0].at(c, x, y)); }), 1e-4);
  EXPECT_GT(largest_difference(out[0], [&](int c, int x, int y) { return double(f.image().at(c, x, y)); }), 1e-4);
}

// Exponents are summed, so the order of two nodes is of no consequence but for rounding.
TEST_P(WeightsInFilters, CommuteWithOthers) {
  for (const auto& other : weights()) {
    Wired w(weight(), true), o(other, true), first(filter(), true), second(filter(), true);
    const auto a = first.node().in(port(), w.node()).in(port(), o.node()).run();
    const auto b = second.node().in(port(), o.node()).in(port(), w.node()).run();
    EXPECT_LE(largest_difference(a[0], [&](int c, int x, int y) { return double(b[0].at(c, x, y)); }), 1e-5) << other;
  }
}

// Image and guides in a mirror: the result in that mirror. Sums are taken in another order.
TEST_P(WeightsInFilters, CommuteWithFlips) {
  Wired w(weight(), true), f(filter(), true);
  const auto out = f.node().in(port(), w.node()).run();
  for (const bool horizontal : {true, false}) {
    const auto mirror = [&](const Image& image, int type) { return mirrored(image, type, horizontal); };
    Wired mirrored_weight(weight(), true, false, mirror), mirrored_filter(filter(), true, false, mirror);
    const auto other = mirrored_filter.node().in(port(), mirrored_weight.node()).run();
    const Image back = mirrored(other[0], QUELL_RADIANCE, horizontal);
    EXPECT_LE(largest_difference(out[0], [&](int c, int x, int y) { return double(back.at(c, x, y)); }), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(All, WeightsInFilters,
                         testing::Combine(testing::ValuesIn(filters()), testing::ValuesIn(weights())),
                         [](const auto& i) { return std::get<0>(i.param) + "_" + std::get<1>(i.param); });

}  // namespace
}  // namespace quell::test
