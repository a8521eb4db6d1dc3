// luminance against its weights in double.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace quell::test {
namespace {

TEST(Luminance, IsAWeightedSum) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {37, 5}}) {
    const auto image = noise_image(width, height, 3, 1, 0, 30);
    const auto by_default = Node("luminance").in("image", image).run("image");
    const auto rec601 = Node("luminance").set("weights", "rec601").in("image", image).run("image");
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double r = image.at(0, x, y), g = image.at(1, x, y), b = image.at(2, x, y);
        // The node reckons in double as well.
        EXPECT_FLOAT_EQ(by_default.at(0, x, y), float(0.2126 * r + 0.7152 * g + 0.0722 * b));
        EXPECT_FLOAT_EQ(rec601.at(0, x, y), float(0.299 * r + 0.587 * g + 0.114 * b));
      }
  }
}

TEST(Luminance, OfGreyIsThatGrey) {
  const auto grey = constant_image(5, 3, 3, 0.4f);
  for (const char* weights : {"rec709", "rec601"})
    EXPECT_FLOAT_EQ(Node("luminance").set("weights", weights).in("image", grey).run("image").at(0, 4, 2), 0.4f);
}

TEST(Luminance, RefusesWhatIsNoColour) {
  const auto scalar = constant_image(4, 4, 1, 1);
  try {
    Node("luminance").in("image", scalar).run();
    FAIL() << "no error";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "image has 1 channels, but luminance is of three: red, green and blue");
  }
}

}  // namespace
}  // namespace quell::test
