// unpack undoes pack, and says which channels there are not.
#include "tests/support/run_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quell::test {
namespace {

TEST(Unpack, UndoesPack) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {17, 3}, {150, 21}}) {
    const auto a = noise_image(width, height, 3, 161), b = noise_image(width, height, 1, 162),
               c = noise_image(width, height, 2, 163);
    Node pack("pack");
    const auto packed = pack.in("images", a).in("images", b).in("images", c).run("image");
    int first = 0;
    for (const Image* image : {&a, &b, &c}) {
      const auto like = constant_image(width, height, image->channels(), 7);
      Node unpack("unpack");
      unpack.set("first", first).in("image", packed).in("like", like).tiles(2, 16);
      EXPECT_TRUE(same_bits(unpack.run("image"), *image)) << first;
      first += image->channels();
    }
  }
}

TEST(Unpack, RefusesChannelsThatThereAreNot) {
  const auto packed = constant_image(4, 4, 6, 0), like = constant_image(4, 4, 3, 0);
  Node fits("unpack"), beyond("unpack");
  EXPECT_NO_THROW(fits.set("first", 3).in("image", packed).in("like", like).shapes());
  beyond.set("first", 4).in("image", packed).in("like", like);
  EXPECT_THAT([&] { beyond.shapes(); },
              testing::ThrowsMessage<std::runtime_error>(
                  "channels 4 to 6 are asked for ('like' has 3), but 'image' has 6, counted from 0"));
}

}  // namespace
}  // namespace quell::test
