// The mean of two halves of a reference, read with and without them.
#include "core/lab/halves.h"

#include "core/image/image.h"

#include <gtest/gtest.h>

namespace quell {
namespace {

// Half a holds 2 x + frame, half b 4 x + 3 frame, the colour 100.
class Halves : public FrameSource {
 public:
  const std::vector<std::int64_t>& frames() const override { return frames_; }
  bool cut_before(std::int64_t) const override { return false; }
  const std::map<std::string, int>& roles() const override { return roles_; }
  std::vector<quell_shape> shapes(std::int64_t, std::span<const std::string> roles) override {
    return std::vector<quell_shape>(roles.size(), quell_shape{3, 2, 1});
  }
  void read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) override {
    for (std::size_t i = 0; i < roles.size(); ++i)
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
          into[i].plane[0][y * into[i].pitch + x] = roles[i] == "color"         ? 100.0f
                                                    : roles[i] == "reference_a" ? float(2 * x + frame)
                                                                                : float(4 * x + 3 * frame);
  }
  std::map<std::string, Repairs> repairs() const override { return {}; }
  void refuse_non_finite(std::span<const std::string> roles) override { refused.assign(roles.begin(), roles.end()); }

  std::vector<std::string> refused;
  std::map<std::string, int> roles_{
      {"color", QUELL_RADIANCE}, {"reference_a", QUELL_RADIANCE}, {"reference_b", QUELL_RADIANCE}};

 private:
  std::vector<std::int64_t> frames_{5};
};

class MeanOfHalvesTest : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(MeanOfHalvesTest, IsReadWithAndWithoutThem) {
  const auto source = with_mean_of_halves(std::make_unique<Halves>());
  const auto& roles = GetParam();
  EXPECT_EQ(source->shapes(5, roles)[0].width, 3);
  std::vector<Image> images;
  std::vector<quell_image> into;
  for (std::size_t i = 0; i < roles.size(); ++i) images.emplace_back(3, 2, 1), into.push_back(images.back().view());
  source->read(5, roles, into);
  for (std::size_t i = 0; i < roles.size(); ++i)
    for (int x = 0; x < 3; ++x) {
      const float a = float(2 * x + 5), b = float(4 * x + 15);
      EXPECT_EQ(images[i].at(0, x, 1), roles[i] == "color"         ? 100
                                       : roles[i] == "reference_a" ? a
                                       : roles[i] == "reference_b" ? b
                                                                   : (a + b) / 2);
    }
}

TEST(MeanOfHalves, MustHaveNothingToRepairInThem) {
  auto halves = std::make_unique<Halves>();
  const auto& refused = halves->refused;
  const auto source = with_mean_of_halves(std::move(halves));
  const std::vector<std::string> roles{"color", "reference"};
  source->refuse_non_finite(roles);
  EXPECT_EQ(refused, (std::vector<std::string>{"color", "reference_a", "reference_b"}));
}

using Roles = std::vector<std::string>;
INSTANTIATE_TEST_SUITE_P(Roles, MeanOfHalvesTest,
                         testing::Values(Roles{"reference"}, Roles{"color", "reference"},
                                         Roles{"reference_b", "reference", "color"},
                                         Roles{"reference_a", "reference_b", "reference"}, Roles{"reference_a"}));

TEST(MeanOfHalves, AReferenceOfItsOwnStays) {
  auto source = std::make_unique<Halves>();
  source->roles_["reference"] = QUELL_RADIANCE;
  const auto* same = source.get();
  EXPECT_EQ(with_mean_of_halves(std::move(source)).get(), same);
}

}  // namespace
}  // namespace quell
