// What every node keeps that makes light from several images, history for one, whatever it does: found from the tables
// alone, so that a new one is held to this by being there. Its first output passes an image of radiance or of any type,
// and it requires others beside it. What knows albedo changes the measure of light and is not among them.
#include "core/bench/synthetic_source.h"
#include "tests/support/altered_frames.h"
#include "tests/support/settings.h"

#include <gtest/gtest.h>
#include <quell/types.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

namespace quell::test {
namespace {

constexpr int kWidth = 97, kHeight = 54;

bool is_light(int type) { return type == QUELL_ANY || type == QUELL_RADIANCE; }
bool is_required(const quell_port& p) { return !(p.flags & (QUELL_OPTIONAL | QUELL_LIST)) && p.type != QUELL_WEIGHT; }

bool wanted(const NodeType& type) {
  if (type.is_weight() || type.outputs()[0].passes < 0 || !is_light(type.outputs()[0].type)) return false;
  const auto inputs = type.inputs();
  return std::ranges::count_if(inputs, is_required) > 1 &&
         std::ranges::none_of(inputs, [](const auto& p) { return p.type == QUELL_ALBEDO || p.type == QUELL_FEATURES; });
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const auto* type : registry().all())
    if (wanted(*type)) list.emplace_back(type->name());
  return list;
}

class HistoryNode : public testing::TestWithParam<std::string> {
 protected:
  using Alter = std::function<Image(const Image&, int type)>;
  const NodeType& type() const { return *registry().find(GetParam()); }

  static Image synthetic(int image_type, int take) {
    if (image_type == QUELL_RADIANCE) return noise_image(kWidth, kHeight, 3, 301u + unsigned(take), 0.1f, 9);
    if (image_type != QUELL_TAPS) return synthetic_image(image_type, kWidth, kHeight, take);
    const auto motion = synthetic_image(QUELL_MOTION, kWidth, kHeight, take);
    return Node("disocclusion").in("motion", motion).run("taps");
  }
  // The required images, each as `alter` makes it.
  Image run(const Setting& setting, const Alter& alter) {
    Node node = node_of(GetParam(), setting);
    images_.clear();
    int take = 0;
    for (const auto& port : type().inputs()) {
      if (!is_required(port)) continue;
      const int image_type = port.type == QUELL_ANY ? int(QUELL_RADIANCE) : port.type;
      const auto plain = synthetic(image_type, take);
      ++take;
      node.in(port.name, images_.emplace_back(alter(plain, image_type)));
    }
    return std::move(node.run()[0]);
  }
  // Where no tap vouches for history there is none.
  bool has_history(int x, int y) const {
    return std::ranges::none_of(images_, [&](const Image& image) {
      const bool taps = image.channels() == 5;
      return taps && image.at(0, x, y) + image.at(1, x, y) + image.at(2, x, y) + image.at(3, x, y) == 0;
    });
  }
  const std::deque<Image>& images() const { return images_; }

 private:
  std::deque<Image> images_;
};

Image as_is(const Image& image, int) { return image.copy(); }

TEST_P(HistoryNode, LeavesAConstantImageAlone) {
  each_setting(type(), [&](const Setting& s) {
    const auto out = run(s, [](const Image& image, int image_type) {
      return image_type == QUELL_RADIANCE ? constant_image(kWidth, kHeight, 3, 0.7f) : image.copy();
    });
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          if (has_history(x, y)) {
            ASSERT_NEAR(out.at(c, x, y), 0.7f, 7e-7) << x << "," << y;
          }
  });
}

TEST_P(HistoryNode, StaysInTheRangeOfItsImages) {
  each_setting(type(), [&](const Setting& s) {
    const auto out = run(s, as_is);
    float low = HUGE_VALF, high = 0;
    for (const auto& image : images())
      for (int c = 0; image.channels() == 3 && c < 3; ++c)
        for (int y = 0; y < kHeight; ++y) {
          const auto [a, b] = std::minmax_element(image.row(c, y), image.row(c, y) + kWidth);
          low = std::min(low, *a), high = std::max(high, *b);
        }
    for (int c = 0; c < 3; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (!has_history(x, y)) continue;
          ASSERT_GE(out.at(c, x, y), low * (1 - 1e-6f)) << x << "," << y;
          ASSERT_LE(out.at(c, x, y), high * (1 + 1e-6f)) << x << "," << y;
        }
  });
}

// Powers of two do not round; but a division by the extent of a box is guarded by 1e-6.
TEST_P(HistoryNode, FollowsTheExposure) {
  for (const float scale : {0.25f, 8.0f})
    each_setting(type(), [&](const Setting& s) {
      const auto out = run(s, as_is);
      const auto bright = run(s, [&](const Image& image, int t) { return brightened(image, t, scale); });
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            ASSERT_NEAR(bright.at(c, x, y), scale * out.at(c, x, y), 1e-5 * scale * out.at(c, x, y)) << x << "," << y;
    });
}

// Sums are taken in another order, and a place between pixels is known to 4e-6 pixels only.
TEST_P(HistoryNode, CommutesWithFlips) {
  for (const bool horizontal : {true, false})
    each_setting(type(), [&](const Setting& s) {
      const auto out = run(s, as_is);
      const auto other = run(s, [&](const Image& image, int t) { return mirrored(image, t, horizontal); });
      const auto back = mirrored(other, QUELL_RADIANCE, horizontal);
      for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) ASSERT_NEAR(back.at(c, x, y), out.at(c, x, y), 5e-5) << x << "," << y;
    });
}

INSTANTIATE_TEST_SUITE_P(All, HistoryNode, testing::ValuesIn(names()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quell::test
