// Every falloff of every weight node that offers some is 1 at no distance, falls from there and is never negative:
// found from the tables alone, so that a new weight node is held to this by being there.
#include "tests/support/each_target.h"
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

constexpr int kWidth = 150, kHeight = 9;

const quell_param* falloff_param(const NodeType& type) {
  for (const auto& p : type.params())
    if (std::string_view(p.name) == "falloff" && p.kind == QUELL_CHOICE) return &p;
  return nullptr;
}

std::vector<std::string> weights() {
  std::vector<std::string> list;
  for (const auto* type : registry().all())
    if (type->is_weight()) list.emplace_back(type->name());
  return list;
}

// Settings of a node's other choices, one list of (parameter, value) a combination.
using Setting = std::vector<std::pair<std::string, std::string>>;
std::vector<Setting> settings(const NodeType& type) {
  std::vector<Setting> all{{}};
  for (const auto& p : type.params()) {
    if (p.kind != QUELL_CHOICE || std::string_view(p.name) == "falloff") continue;
    std::vector<Setting> more;
    for (const auto& s : all)
      for (int c = 0; c < p.choice_count; ++c) {
        more.push_back(s);
        more.back().emplace_back(p.name, p.choices[c]);
      }
    all = std::move(more);
  }
  return all;
}

// Random pairs of pixels of images that a renderer might give, or of one value throughout.
// With `change`, what it does to the node and its images comes before.
using Change = std::function<void(Node&, Image&, int type)>;
std::vector<double> pair_weights(const std::string& name, const Setting& setting, const char* falloff, bool constant,
                                 const Change& change = {}) {
  Node node(name);
  for (const auto& [param, choice] : setting) node.set(param, choice);
  if (falloff) node.set("falloff", std::string(falloff));
  std::deque<Image> images;
  std::uint32_t seed = 90;
  for (const auto& port : node.type().inputs()) {
    const int type = port.type == QUELL_ANY ? int(QUELL_RADIANCE) : port.type;
    auto& image = images.emplace_back(typical_input(type, kWidth, kHeight, ++seed));
    if (constant)
      for (int c = 0; c < image.channels(); ++c)
        for (int y = 0; y < kHeight; ++y) std::fill_n(image.row(c, y), kWidth, image.at(c, 4, 4));
    if (change) change(node, image, type);
    node.in(port.name, image);
  }
  std::vector<double> list;
  for (const auto& [dx, dy] : {std::pair{1, 0}, {3, 2}, {-5, 1}})
    for (int y = 0; y + dy < kHeight; ++y) {
      const auto row = weights_of(node, kWidth, kHeight, y, {{dx, dy}}, false)[0];
      list.insert(list.end(), row.begin() + std::max(0, -dx), row.end() - std::max(0, dx));
    }
  return list;
}

class Falloffs : public testing::TestWithParam<std::string> {};

TEST_P(Falloffs, AreOneAtNoDistance) {
  const auto& type = *registry().find(GetParam());
  const auto* p = falloff_param(type);
  for_each_target([&] {
    for (const auto& setting : settings(type))
      for (int c = 0; c < (p ? p->choice_count : 1); ++c)
        for (const double w : pair_weights(GetParam(), setting, p ? p->choices[c] : nullptr, true))
          // A cosine of unit vectors is 1 to 1e-7 only, which a high power makes much of.
          ASSERT_NEAR(w, 1, 5e-5) << (p ? p->choices[c] : "");
  });
}

// Pairs in the order of the exponential, which tells distances apart, must be in the order of every other one.
TEST_P(Falloffs, FallAndAreNeverNegative) {
  const auto& type = *registry().find(GetParam());
  const auto* p = falloff_param(type);
  for_each_target([&] {
    for (const auto& setting : settings(type)) {
      const auto order = pair_weights(GetParam(), setting, p ? "exponential" : nullptr, false);
      std::vector<std::size_t> by_distance(order.size());
      for (std::size_t i = 0; i < order.size(); ++i) by_distance[i] = i;
      std::ranges::stable_sort(by_distance, [&](std::size_t a, std::size_t b) { return order[a] > order[b]; });
      ASSERT_GE(order.size(), 1000u);
      for (int c = 0; c < (p ? p->choice_count : 1); ++c) {
        const auto w = pair_weights(GetParam(), setting, p ? p->choices[c] : nullptr, false);
        double last = 1;
        for (const auto i : by_distance) {
          ASSERT_GE(w[i], 0);
          // Where the exponential is as good as 0, distances are told apart no more.
          if (order[i] < 1e-30) continue;
          ASSERT_LE(w[i], last + 2e-6) << (p ? p->choices[c] : "");
          last = w[i];
        }
      }
    }
  });
}

// Logarithms and roots of images have no measure that could be another.
bool is_linear(const Setting& setting) {
  return std::ranges::none_of(setting, [](const auto& s) { return s.first == "space" && s.second != "linear"; });
}

// P4 for weights: in a measure that is smaller by a power of two all distances are larger, and so are the thresholds of
// the same measure; then the weights are the same, to the bit. Which parameters these are the test finds out: there
// must be a set of them for each setting.
TEST_P(Falloffs, KnowNoUnit) {
  const auto& type = *registry().find(GetParam());
  const auto* p = falloff_param(type);
  std::vector<std::string> numbers;
  for (const auto& param : type.params())
    if (param.kind == QUELL_FLOAT) numbers.emplace_back(param.name);
  const Instance defaults(type);
  const auto weights_in_measure = [&](const Setting& setting, const char* falloff, unsigned scaled, float scale) {
    return pair_weights(GetParam(), setting, falloff, false, [&](Node& node, Image& image, int image_type) {
      for (std::size_t i = 0; i < numbers.size(); ++i)
        if (scaled >> i & 1u) node.set(numbers[i], scale * defaults.get_float(type.find_param(numbers[i])));
      const bool directions = image_type == QUELL_NORMAL, counted = image_type == QUELL_ID;
      if (directions || counted) return;
      const float by = image_type == QUELL_VARIANCE ? scale * scale : scale;
      for (int c = 0; c < image.channels(); ++c)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) image.at(c, x, y) *= by;
    });
  };
  for (const auto& setting : settings(type)) {
    if (!is_linear(setting)) continue;
    bool found = false;
    for (unsigned scaled = 0; scaled < 1u << numbers.size() && !found; ++scaled) {
      found = true;
      for (int c = 0; c < (p ? p->choice_count : 1); ++c)
        for (const float scale : {0.5f, 4.0f}) {
          const char* falloff = p ? p->choices[c] : nullptr;
          found = found && weights_in_measure(setting, falloff, scaled, scale) ==
                               weights_in_measure(setting, falloff, scaled, 1);
        }
    }
    EXPECT_TRUE(found) << (setting.empty() ? "" : setting[0].second);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Falloffs, testing::ValuesIn(weights()), [](const auto& i) { return i.param; });

}  // namespace
}  // namespace quell::test
