// pack joins channels in order, and says what it cannot join.
#include "tests/support/run_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace quell::test {
namespace {

TEST(Pack, ChannelsFollowEachOther) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {150, 21}}) {
    const auto color = noise_image(width, height, 3, 151), depth = noise_image(width, height, 1, 152),
               features = noise_image(width, height, 5, 153);
    Node node("pack");
    const auto out = node.in("images", color).in("images", depth).in("images", features).tiles(2, 16).run("image");
    ASSERT_EQ(out.channels(), 9);
    int channel = 0;
    for (const Image* image : {&color, &depth, &features})
      for (int c = 0; c < image->channels(); ++c, ++channel)
        for (int y = 0; y < height; ++y)
          EXPECT_EQ(std::memcmp(out.row(channel, y), image->row(c, y), std::size_t(width) * sizeof(float)), 0)
              << channel << " " << y;
  }
}

TEST(Pack, RefusesAnEmptyList) {
  Node node("pack");
  EXPECT_THAT([&] { node.shapes(); },
              testing::ThrowsMessage<std::runtime_error>("'images' is empty: name at least one image"));
}

}  // namespace
}  // namespace quell::test
